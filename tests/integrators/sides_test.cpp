// Light that falls on one side of a surface is seen from that side alone, whichever of them is outside.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace sides_test {

const std::string kPhotons = R"("integer photons" 100000 "float radius" 0.05)";

/// A disk across the view at distance 2, with a lamp on its axis at distance 1 from it, before or behind it.
Image disk(const std::string& integrator, const std::string& surface, bool lamp_in_front) {
  TestScene test(fmt::format(R"(
Integrator {}
Camera "orthographic" "float screenwindow" [-.1 .1 -.1 .1]
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
WorldBegin
LightSource "point" "rgb I" [6 6 6] "point3 from" [0 0 {}]
{}
Translate 0 0 2
Shape "disk"
)",
                             integrator, lamp_in_front ? 1 : 3, surface));
  return test.render(FileFrame(0), 10);
}

double mean(const Image& image) {
  double sum = 0;
  for (const Rgb& pixel : image.pixels) sum += static_cast<double>(pixel.g);
  return sum / static_cast<double>(image.pixels.size());
}

class Sides : public testing::TestWithParam<std::string> {};

// With f the scattering function, straight on, L = f I / d^2; for a matte surface f is reflectance / pi. Towards the
// pixels' edge, 0.1 off the axis, that falls by 2% at most, and photons within a disc of 0.05 see no more of it.
TEST_P(Sides, AreLitFromTheirOwnSideOnly) {
  const double expected = 0.5 * 6 / std::acos(-1.);
  for (const char* orientation : {"", "ReverseOrientation "}) {
    const std::string matte = orientation + std::string("Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]");
    EXPECT_NEAR(mean(disk(GetParam(), matte, true)), expected, 0.08 * expected) << orientation;
    EXPECT_EQ(mean(disk(GetParam(), matte, false)), 0) << orientation;
  }
}

// Under a coat photons are weighted one by one; beyond a rough pane of index 1.1 most light goes almost straight on.
TEST_P(Sides, OfSurfacesThatScatterByDirection) {
  const std::string rough = R"("float roughness" .5 "bool remaproughness" false)";
  for (const char* orientation : {"", "ReverseOrientation "}) {
    const std::string coat = orientation + ("Material \"coateddiffuse\" " + rough);
    EXPECT_GT(mean(disk(GetParam(), coat, true)), 0.5) << orientation;
    EXPECT_EQ(mean(disk(GetParam(), coat, false)), 0) << orientation;
    const std::string pane = orientation + ("Material \"dielectric\" \"float eta\" 1.1 " + rough);
    EXPECT_GT(mean(disk(GetParam(), pane, false)), 1) << orientation;
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Sides,
                         testing::Values(R"("dsppm" "string estimator" "kz11" )" + kPhotons,
                                         R"("dsppm" "string estimator" "hj09" )" + kPhotons, "\"sppm\" " + kPhotons,
                                         R"("photonmap" "integer photons" 100000 "integer causticphotons" 1000)",
                                         "\"path\"", R"("vcm" "integer photons" 5000)"),
                         [](const auto& of) { return "Case" + std::to_string(of.index); });

}  // namespace sides_test
}  // namespace dspm::test
