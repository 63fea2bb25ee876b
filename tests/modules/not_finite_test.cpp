// Plugins that give NaN: it stays out of the images, which keep all else, and the plugin is named with a pixel.
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/image/image.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace not_finite_test {

struct Fault {
  std::string kind, from, to;  // what of the scene is replaced
};

const std::string kScene = R"(
Plugin ")" DSPM_TEST_MODULES R"(/libhollow.so"
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 16 "integer yresolution" 12 "string filename" "out.exr"
WorldBegin
LightSource "point" "point3 from" [0 0 -3] "rgb I" [12 12 12]
LightSource "infinite" "rgb L" [.1 .1 .1]
Material "diffuse"
AttributeBegin
  Translate 0 0 3
  Shape "sphere" "float radius" 2
AttributeEnd
Rotate 180 0 1 0
Shape "disk" "float radius" 0.8
)";

const std::vector<Fault> kFaults = {
    {"material", "Material \"diffuse\"", "Material \"hollow\""},
    {"material", "Material \"diffuse\"", "Material \"hollow\" \"string fault\" \"weight\""},
    {"material", "Material \"diffuse\"", "Material \"hollow\" \"string fault\" \"direction\""},
    {"material", "Material \"diffuse\"", "Material \"hollow\" \"string fault\" \"constant\""},
    {"light", "LightSource \"point\" \"point3 from\" [0 0 -3] \"rgb I\" [12 12 12]",
     "AttributeBegin Translate 0 0 -3 LightSource \"hollow\" AttributeEnd"},
    {"camera", "Camera \"perspective\" \"float fov\" 45", "Camera \"hollow\""},
    {"shape", "Shape \"disk\" \"float radius\" 0.8", "Shape \"hollow\""},
};

/// `constant` is asked for by those integrators only that know of constant scattering functions.
bool is_asked_for(const Fault& fault, const std::string& integrator) {
  return fault.to.find("constant") == fault.to.npos || integrator.starts_with(R"("dsppm")") ||
         integrator == R"("sppm")";
}

class NotFinite : public testing::TestWithParam<const char*> {};

TEST_P(NotFinite, IsKeptOutAndTold) {
  const std::string integrator = GetParam();
  for (const Fault& fault : kFaults) {
    if (!is_asked_for(fault, integrator)) continue;
    SCOPED_TRACE(fault.to);
    const TemporaryDirectory directory;
    std::string scene = kScene;
    scene.replace(scene.find(fault.from), fault.from.size(), fault.to);
    put_file(directory / "scene.dsc", "Integrator " + integrator + scene);
    Arguments words{"scene.dsc", "--iterations", "4", "--quiet", "--stats"};
    if (integrator != R"("path")") words = words + Arguments{"--photons", "20000"};
    const Outcome outcome = run(directory, words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string place = integrator == R"("path")" ? "at pixel x = " : "";  // photons belong to no pixel
    const std::string told =
        fault.kind + " \"hollow\" of libhollow.so gave values that are negative or not finite, first " + place;
    EXPECT_NE(outcome.err.find(told), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("contributions were negative or not finite and were left out"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(outcome.err.find("written as black"), std::string::npos) << "it has come as far as the driver";
    const Image image = read_image(directory / "out.exr");
    EXPECT_TRUE(std::all_of(image.pixels.begin(), image.pixels.end(), [](const Rgb& c) { return is_finite(c); }));
    EXPECT_GT(luminance(image.at(1, 6)), 0.01f);
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, NotFinite,
                         testing::Values(R"("dsppm" "string indirect" "photons")", R"("sppm")", R"("photonmap")",
                                         R"("photonmap" "integer finalgather" 2)", R"("path")", R"("vcm")"));

}  // namespace not_finite_test
}  // namespace dspm::test
