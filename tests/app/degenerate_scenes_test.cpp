// Scenes at the edge of sense, as files hold them by accident: no crash, no number in an image that is not finite, and
// what is left out is told and counted.
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/image/image.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

struct Degenerate {
  const char *name, *text;
};

// Walls before and behind the camera: what stands between them leaves the scene's size as it is.
const std::string kBefore = R"(
Frames 2
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "string filename" "d.exr"
WorldBegin
LightSource "point" "rgb I" [8 8 8] "point3 from" [0 2 -3]
Shape "disk" "float radius" 10 "float height" 3
Shape "disk" "float radius" 10 "float height" -6
)";

/// Geometry that is not there: the image is that of a scene without it.
const Degenerate kNothingThere[] = {
    {"DegenerateTriangles", R"(Shape "trianglemesh" "integer indices" [0 1 2 0 0 1 3 4 5]
                               "point3 P" [0 0 0 0 0 0 0 0 0 -1 0 0 0 0 0 1 0 0])"},
    {"TinyTriangles", R"(Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 1e-30 0 0 0 1e-30 0])"},
    {"AFlatSubdivision",
     R"(Shape "loopsubdiv" "integer levels" 2 "integer indices" [0 1 2] "point3 P" [0 0 0 0 0 0 0 0 0])"},
    {"PatchOfOnePoint", R"(Shape "bilinearmesh" "point3 P" [0 0 0 0 0 0 0 0 0 0 0 0])"},
    {"PatchInALine", R"(Shape "bilinearmesh" "point3 P" [0 0 0 .1 0 0 .2 0 0 .4 0 0])"},
    {"AFlatLight", R"(AreaLightSource "diffuse" "rgb L" [5 5 5]
                      Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-1 0 0 0 0 0 1 0 0])"},
    {"ATinyLight", R"(AreaLightSource "diffuse" "rgb L" [5 5 5] Shape "sphere" "float radius" 1e-30)"},
    {"ATinyScale", R"(Scale 1e-30 1e-30 1e-30 Shape "sphere")"},
    {"ABlackLight", R"(LightSource "point" "rgb I" [0 0 0])"}};

const Degenerate kSomething[] = {
    {"HugeCoordinates", R"(Shape "trianglemesh" "integer indices" [0 1 2]
                           "point3 P" [-3e38 -3e38 1 3e38 0 1 0 3e38 1])"},
    {"AHugeSphere", R"(Shape "sphere" "float radius" 1e19)"},
    {"ALargerSphere", R"(Shape "sphere" "float radius" 1e38)"},
    {"AHugeScale", R"(Scale 1e30 1e30 1e30 Shape "sphere" Shape "disk")"},
    {"IdenticalTriangles", R"(Shape "trianglemesh" "integer indices" [0 1 2 0 1 2 0 1 2 2 1 0]
                              "point3 P" [-1 -1 0 1 -1 0 0 1 0])"},
    {"ALightOnASurface", R"(LightSource "point" "rgb I" [5 5 5] "point3 from" [0 0 3])"},
    {"ABrightLight", R"(LightSource "point" "rgb I" [1e30 1e30 1e30] "point3 from" [0 0 -3])"},
    {"ALampTooBrightForSums",
     R"(AreaLightSource "diffuse" "rgb L" [1e38 1e38 1e38] Shape "sphere" "float radius" 0.2)"},
    {"EtaHuge", R"(Material "dielectric" "float eta" 1e30 Shape "sphere")"},
    {"EtaTiny", R"(Material "dielectric" "float eta" 1e-30 Shape "sphere")"},
    {"EtaOne", R"(Material "dielectric" "float eta" 1 Shape "sphere")"},
    {"RoughEtaHuge", R"(Material "dielectric" "float eta" 1e10 "float roughness" 0.3 Shape "sphere")"},
    {"RoughEtaTiny", R"(Material "dielectric" "float eta" 1e-10 "float roughness" 0.3 Shape "sphere")"},
    {"RoughnessTiny", R"(Material "dielectric" "float roughness" 1e-20 Shape "sphere")"},
    {"RoughnessHuge", R"(Material "conductor" "float roughness" 1e20 Shape "sphere")"},
    {"AMetalOfNothing", R"(Material "conductor" "rgb eta" [0 0 0] "rgb k" [0 0 0] Shape "sphere")"},
    {"AMetalOfHugeIndex", R"(Material "conductor" "rgb eta" [1e30 1e30 1e30] "rgb k" [1e30 1e30 1e30] Shape "sphere")"},
    {"ATextureThatOverflows", R"(Texture "a" "float" "scale" "float tex" 1e38 "float scale" 1e38
                                 Texture "t" "float" "mix" "texture tex1" "a" "float tex2" -1 "float amount" 0.5
                                 Material "conductor" "texture roughness" "t" Shape "sphere")"},
    {"NormalsOfNoLength", R"(Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-1 -1 0 1 -1 0 0 1 0]
                             "normal N" [0 0 0 0 0 0 0 0 0])"},
    {"OppositeNormals", R"(Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-1 -1 0 1 -1 0 0 1 0]
                           "normal N" [0 0 1 0 0 -1 0 0 1])"},
    {"OneTextureCoordinate", R"(Material "conductor" "float uroughness" 0.1 "float vroughness" 0.4
                                Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-1 -1 0 1 -1 0 0 1 0]
                                "point2 uv" [0 0 0 0 0 0])"}};

const Degenerate kRefused[] = {
    {"an infinite coordinate", R"(Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 1e39 0 0 0 1 0])"},
    {"a coordinate that is no number",
     R"(Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 nan 0 0 0 1 0])"},
    {"eta 0", R"(Material "dielectric" "float eta" 0 Shape "sphere")"},
    {"a negative eta", R"(Material "dielectric" "float eta" -1.5 Shape "sphere")"},
    {"an infinite eta", R"(Material "dielectric" "float eta" 1e39 Shape "sphere")"},
    {"a negative roughness", R"(Material "conductor" "float roughness" -1 Shape "sphere")"},
    {"radius 0", R"(Shape "sphere" "float radius" 0)"},
    {"a radius that is no number", R"(Shape "sphere" "float radius" nan)"},
    {"a lamp of radius 0", R"(AreaLightSource "diffuse" "rgb L" [5 5 5] Shape "sphere" "float radius" 0)"},
    {"a lamp of infinite power", R"(AreaLightSource "diffuse" "rgb L" [5 5 5] Shape "sphere" "float radius" 1e30)"},
    {"a reflectance beyond 1", R"(Material "diffuse" "rgb reflectance" [1e30 1e30 1e30] Shape "sphere")"},
    {"a light of infinite power", R"(LightSource "point" "rgb I" [1e38 1e38 1e38])"},
    {"a light of negative power", R"(LightSource "point" "rgb I" [-5 -5 -5])"},
    {"a spot without direction", R"(LightSource "spot" "point3 from" [0 0 -3] "point3 to" [0 0 -3])"},
    {"a cone without width", R"(LightSource "spot" "point3 to" [0 0 1] "float coneangle" 0)"},
    {"scale 0", R"(Scale 0 0 0 Shape "sphere")"},
    {"a flat scale", R"(Scale 1 0 1 Shape "sphere")"},
    {"a singular matrix", R"(ConcatTransform [1 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1] Shape "sphere")"},
    {"a projective matrix", R"(ConcatTransform [1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1] Shape "sphere")"},
    {"a rotation about nothing", R"(Rotate 30 0 0 0 Shape "sphere")"},
    {"normals that are no numbers", R"(Shape "trianglemesh" "integer indices" [0 1 2]
                                       "point3 P" [-1 -1 0 1 -1 0 0 1 0] "normal N" [nan 0 0 0 nan 0 0 0 nan])"}};

void put_scene(const TemporaryDirectory& directory, const std::string& text,
               const std::string& integrator = R"("dsppm")") {
  put_file(directory / "d.dsc", "Integrator " + integrator + kBefore + "AttributeBegin\n" + text + "\nAttributeEnd\n");
}

Outcome render_with(const TemporaryDirectory& directory, const std::string& integrator) {
  std::filesystem::remove(directory / "c");
  std::vector<std::string> words = {"d.dsc", "--iterations", "3", "--stats=s.json", "--checkpoint", "c"};
  if (integrator != R"("path")") words.insert(words.end(), {"--photons", "2000"});
  return run(directory, words);
}

std::vector<Image> images(const TemporaryDirectory& directory) {
  return {read_image(directory / "d.0001.exr"), read_image(directory / "d.0002.exr")};
}

bool all_finite(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](const Rgb& c) { return is_finite(c); });
}

class DegenerateScene : public ::testing::TestWithParam<const char*> {};

TEST_P(DegenerateScene, WhatIsNotThereChangesNothing) {
  const TemporaryDirectory directory;
  put_scene(directory, "", GetParam());
  ASSERT_EQ(render_with(directory, GetParam()).code, 0);
  const std::vector<Image> without = images(directory);
  for (const Degenerate& scene : kNothingThere) {
    put_scene(directory, scene.text, GetParam());
    const Outcome outcome = render_with(directory, GetParam());
    ASSERT_EQ(outcome.code, 0) << scene.name << outcome.err;
    EXPECT_TRUE(images(directory) == without) << scene.name;
  }
}

TEST_P(DegenerateScene, ImagesAreFinite) {
  const TemporaryDirectory directory;
  for (const Degenerate& scene : kSomething) {
    put_scene(directory, scene.text, GetParam());
    const Outcome outcome = render_with(directory, GetParam());
    ASSERT_EQ(outcome.code, 0) << scene.name << outcome.err;
    for (const Image& image : images(directory)) EXPECT_TRUE(all_finite(image)) << scene.name;
    const bool let_through = outcome.err.find("written as black") != std::string::npos;
    EXPECT_TRUE(!let_through || scene.name == std::string("ALampTooBrightForSums")) << scene.name << outcome.err;
    const bool counted = contents(directory / "s.json").find("\"invalid\": 0") == std::string::npos;
    const bool left_out = outcome.err.find("they are left out") != std::string::npos;
    EXPECT_EQ(counted, left_out) << scene.name << outcome.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, DegenerateScene,
                         ::testing::Values(R"("dsppm")", R"("sppm" "string emission" "power")",
                                           R"("photonmap" "string emission" "power")",
                                           R"("photonmap" "integer causticphotons" 2000 "integer finalgather" 2)",
                                           R"("path")", R"("vcm" "string emission" "power")"));

TEST(SenselessScene, IsRefused) {
  const TemporaryDirectory directory;
  for (const Degenerate& scene : kRefused) {
    put_scene(directory, scene.text);
    const Outcome outcome = run(directory, {"d.dsc", "--check"});
    EXPECT_EQ(outcome.code, 1) << scene.name;
    EXPECT_EQ(outcome.err.find("d.dsc:"), 0u) << scene.name << outcome.err;
    EXPECT_NE(outcome.err.find("error: "), std::string::npos) << scene.name << outcome.err;
  }
}

}  // namespace
}  // namespace dspm::test
