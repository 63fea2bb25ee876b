// Previews of few iterations have the colours of finals: where a footprint, which shrinks from one iteration to the next,
// averages over a texture, it may change noise, but no mean. Details of these textures are much finer than a pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/image/write_floats.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace few_iterations_test {

/// Pictures of two pixels that repeat a hundred times: heights and shares from 0 to 1, colours, and normals that lean by 35
/// degrees to one side and the other.
class FinePictures {
 public:
  FinePictures() {
    Image share(2, 1), colour(2, 1), normal(2, 1);
    share.pixels = {Rgb(1), Rgb(0)};
    colour.pixels = {{0.9f, 0.6f, 0.1f}, {0.05f, 0.1f, 0.6f}};
    const float across = 0.5f * std::sin(0.6f), up = 0.5f + 0.5f * std::cos(0.6f);
    normal.pixels = {{0.5f + across, 0.5f, up}, {0.5f - across, 0.5f, up}};
    write_pfm(directory_ / "share.pfm", share);
    write_pfm(directory_ / "colour.pfm", colour);
    write_pfm(directory_ / "normal.pfm", normal);
  }
  std::string textures() const {
    const auto texture = [&](const std::string& name, const std::string& type, const std::string& more) {
      return fmt::format(R"(Texture "{}" "{}" "imagemap" "string filename" "{}" "float uscale" 100 {}
)",
                         name, type, (directory_ / (name + ".pfm")).string(), more);
    };
    return texture("share", "float", "") + texture("colour", "spectrum", "") + texture("normal", "spectrum", "") + R"(
Texture "heights" "float" "scale" "texture tex" "share" "float scale" .015
Texture "edges" "spectrum" "threshold" "texture tex" "share" "float edge" .7
Texture "twice" "spectrum" "product" "texture tex1" "colour" "texture tex2" "colour"
Texture "bright" "spectrum" "scale" "texture tex" "colour" "float scale" 3
Texture "squares" "spectrum" "checkerboard" "float uscale" 120 "float vscale" 120
Scale .01 .01 .01
Texture "peel" "spectrum" "wrinkled"
Texture "stone" "spectrum" "marble" "float scale" 3
Scale 100 100 100
)";
  }

 private:
  TemporaryDirectory directory_;
};

/// A floor under a sun, a lamp and a sky.
std::string floor(const std::string& integrator, const std::string& textures, const std::string& material) {
  return "Integrator " + integrator + R"(
LookAt 0 -3 2.2  0 0 0  0 0 1
Camera "perspective" "float fov" 30
PixelFilter "box"
Film "rgb" "integer xresolution" 10 "integer yresolution" 10
WorldBegin
LightSource "infinite" "rgb L" [.2 .3 .4]
LightSource "distant" "rgb L" [1 .8 .5] "point3 from" [2 1 2] "point3 to" [0 0 0]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [4 4 4]
  Translate -2.5 3 2.5  Shape "sphere" "float radius" .7
AttributeEnd
)" + textures +
         material + R"(
Shape "bilinearmesh" "point3 P" [-2 -2 0  2 -2 0  -2 2 0  2 2 0]
)";
}

struct Case {
  std::string name, material;
  bool also_photons = false;  // integrators do not know where a vertex has its normals and colours from: a few will do
};

const Case kCases[] = {
    {"picture", R"("diffuse" "texture reflectance" "colour")", true},
    {"checkerboard", R"("diffuse" "texture reflectance" "squares")"},
    {"matte paint", R"("principled" "texture basecolor" "colour" "float roughness" .6)"},
    {"bump", R"("conductor" "float roughness" .2 "texture displacement" "heights")"},
    {"bump on paint",
     R"("principled" "texture basecolor" "colour" "float roughness" .45 "texture displacement" "heights")", true},
    {"normals", R"("principled" "float metallic" 1 "float roughness" .5 "texture normaltexture" "normal")"},
    {"normals of a matte floor", R"("diffuse" "texture reflectance" "colour" "texture normaltexture" "normal")"},
    {"normals of a coat",
     R"("principled" "float coat" 1 "float coatroughness" .4 "texture coatnormaltexture" "normal")", true},
    {"roughness", R"("conductor" "texture roughness" "share")", true},
    {"roughness of paint", R"("principled" "texture roughness" "share" "rgb basecolor" [.1 .1 .1])"},
    {"metallic", R"("principled" "texture metallic" "share" "texture basecolor" "colour")"},
    {"varnish", R"("coateddiffuse" "texture reflectance" "colour" "float roughness" .3)"},
    {"threshold", R"("diffuse" "texture reflectance" "edges")"},
    {"product", R"("diffuse" "texture reflectance" "twice")"},
    {"brighter than white", R"("diffuse" "texture reflectance" "bright")"},
    {"marble", R"("diffuse" "texture reflectance" "stone")"},
    {"peel", R"("diffuse" "texture reflectance" "peel")"},
    {"colours in holes", R"("principled" "texture basecolor" "colour" "texture alpha" "share")"},
};

const FinePictures& pictures() {
  static const FinePictures all;
  return all;
}

class FewIterations : public testing::TestWithParam<Case> {};

TEST_P(FewIterations, HaveTheMeanOfMany) {
  const auto image = [&](const std::string& integrator, int iterations, int seeds) {
    return rendered(floor(integrator, pictures().textures(), "Material " + GetParam().material), iterations, seeds, 1);
  };
  for (const char* integrator :
       {R"("path" "integer maxdepth" 2)", R"("vcm" "integer maxdepth" 2 "integer photons" 300)",
        R"("dsppm" "integer maxdepth" 2 "integer photons" 1000 "string emission" "power")"}) {
    const bool path = std::string_view(integrator).find("path") == 1;
    if (!path && !GetParam().also_photons) continue;
    const Verdict verdict = agreement(image(integrator, 1, 48), image(integrator, 16, 12), {0.001, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

// Photons on relief count by the normal of the point that gathers them, whatever the radius.
TEST_P(FewIterations, OfPhotonsBringWhatPathsFind) {
  if (!GetParam().also_photons) return;
  const auto image = [&](const std::string& integrator, int iterations) {
    return rendered(floor(integrator, pictures().textures(), "Material " + GetParam().material), iterations, 16, 1);
  };
  const Tiles path = image(R"("path" "integer maxdepth" 2)", 32);
  const std::string photons =
      R"("integer maxdepth" 2 "integer photons" 20000 "string emission" "power" "float radius" .2)";
  for (const std::string& integrator : {R"("dsppm" "string direct" "photons" )" + photons,
                                        R"("dsppm" "string estimator" "hj09" "string direct" "photons" )" + photons}) {
    const Verdict verdict = agreement(image(integrator, 2), path, {0.001, 0.02});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, FewIterations, testing::ValuesIn(kCases),
                         [](const auto& of) { return std::to_string(of.index); });

// Lookups over a footprint have less noise where they are of use.
TEST(Footprints, MakeMatteFloorsSmooth) {
  const auto variance = [](const std::string& option) {
    double sum = 0;
    for (const char* colour : {"colour", "squares"})
      for (const Tiles::Mean& mean :
           rendered(option + floor(R"("path" "integer maxdepth" 1)", pictures().textures(),
                                   fmt::format(R"(Material "diffuse" "texture reflectance" "{}")", colour)),
                    1, 16)
               .means)
        sum += mean.variance;
    return sum;
  };
  EXPECT_LT(variance(""), 0.5 * variance("Option \"disabletexturefiltering\" true\n"));
}

}  // namespace few_iterations_test
}  // namespace dspm::test
