// What a light without extent sends through a pane onto glossy metal. No ray along the metal's lobe finds that light, and
// no shadow ray gets through the pane to it, so photons have to bring it, whether the lobe gathers them or is followed.
//
//   L = E cos(t) T(t) f,  f = F D G2 / (4 cos(i) cos(o))
//
// E: irradiance across the light; t: its angle to the pane and to the metal, which are parallel; T = (1 - R) / (1 + R):
// what a pane passes of which each face reflects R, with all that is reflected to and fro inside; F: Fresnel reflectance of
// the index 0.2 + 3.9i; D and G2: GGX with Smith's height-correlated shadowing. Paths of two bounces leave out what the
// metal and the pane throw on each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "dspm/base/math/moments.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace hidden_light_test {

using test::TestScene;

constexpr double kPiExact = std::numbers::pi;

struct Direction {
  double x, z;  // in the plane of the light and the camera; the metal's normal is z
};
Direction normalized(double x, double z) { return {x / std::hypot(x, z), z / std::hypot(x, z)}; }

// The camera stands between the metal (z = 0) and the pane (z = 0.5); the light shines from far behind the pane.
const Direction kToLight = normalized(0.3, 1), kToCamera = normalized(-0.12, 0.4);

/// Of unpolarised light at an angle of that cosine, from air to a medium of this index.
double fresnel(double cos, std::complex<double> index) {
  const std::complex<double> refracted = std::sqrt(1. - (1 - cos * cos) / (index * index));
  const auto s = (cos - index * refracted) / (cos + index * refracted);
  const auto p = (index * cos - refracted) / (index * cos + refracted);
  return (std::norm(s) + std::norm(p)) / 2;
}

double ggx_reflection(const Direction& i, const Direction& o, double alpha, std::complex<double> index = {0.2, 3.9}) {
  const Direction m = normalized(i.x + o.x, i.z + o.z);
  const double r2 = m.x * m.x / (alpha * alpha) + m.z * m.z, d = 1 / (kPiExact * alpha * alpha * r2 * r2);
  const auto lambda = [&](const Direction& w) {
    return (std::sqrt(1 + alpha * alpha * (w.x * w.x) / (w.z * w.z)) - 1) / 2;
  };
  const double cos = i.x * m.x + i.z * m.z;
  return fresnel(cos, index) * d / (1 + lambda(i) + lambda(o)) / (4 * i.z * o.z);
}

double expected_radiance(double irradiance, double alpha) {
  const double r = fresnel(kToLight.z, 1.5);
  return irradiance * kToLight.z * (1 - r) / (1 + r) * ggx_reflection(kToLight, kToCamera, alpha);
}

std::string pane_over_metal(const std::string& frames, const std::string& integrator, const std::string& light,
                            const std::string& material) {
  return fmt::format(R"(
{}
Integrator {} "integer maxdepth" 2
LookAt -0.12 0 0.4  0 0 0  0 1 0
Camera "perspective" "float fov" 0.5
PixelFilter "box"
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
WorldBegin
LightSource {}
Material {} "bool remaproughness" false
Shape "disk"
Material "thindielectric"
Translate 0 0 0.5
Shape "disk" "float radius" 1.2
)",
                     frames, integrator, light, material);
}

std::string metal(const std::string& roughness) {
  return R"("conductor" "rgb eta" [.2 .2 .2] "rgb k" [3.9 3.9 3.9] "bool energycompensation" false )" + roughness;
}

constexpr const char* kSun = R"("distant" "rgb L" [2 2 2] "point3 from" [0.3 0 1] "point3 to" [0 0 0])";
// 2 W/sr from a distance of 2; the cone covers the disc that is gathered from and little more.
constexpr const char* kSpot =
    R"("spot" "rgb I" [8 8 8] "point3 from" [.5746957711 0 1.9156525705] "point3 to" [0 0 0] "float coneangle" 3 "float conedeltaangle" 1)";

double mean_luminance(const Image& image) {
  double sum = 0;
  for (const Rgb& pixel : image.pixels) sum += static_cast<double>(luminance(pixel));
  return sum / static_cast<double>(image.pixels.size());
}

struct Case {
  const char* integrator;  // its radius follows
  int iterations;
};

class HiddenLight : public ::testing::TestWithParam<Case> {
 protected:
  /// 0.05 and 0.2 are followed, 0.3 gathers.
  static void expect_radiance(const char* light, double radius, std::initializer_list<double> alphas) {
    for (const double alpha : alphas) {
      const auto [integrator, iterations] = GetParam();
      TestScene scene(pane_over_metal("", fmt::format("{} {}", integrator, radius), light,
                                      metal(fmt::format("\"float roughness\" {}", alpha))));
      EXPECT_NEAR(mean_luminance(scene.render(FileFrame(0), iterations)) / expected_radiance(2, alpha), 1, 0.02)
          << integrator << ", alpha " << alpha;
    }
  }
};

TEST_P(HiddenLight, OfTheSunThroughAPane) { expect_radiance(kSun, 0.6, {0.05, 0.3}); }

TEST_P(HiddenLight, OfASpotThroughAPane) { expect_radiance(kSpot, 0.03, {0.2, 0.3}); }

INSTANTIATE_TEST_SUITE_P(
    Integrators, HiddenLight,
    ::testing::Values(
        Case{R"("sppm" "integer photons" 40000 "float radius")", 32},
        Case{R"("sppm" "integer photons" 40000 "string estimator" "hj09" "float radius")", 32},
        Case{R"("dsppm" "integer photons" 40000 "float radius")", 32},
        Case{R"("dsppm" "integer photons" 40000 "string estimator" "hj09" "float radius")", 32},
        Case{R"("dsppm" "integer photons" 40000 "string direct" "sampled" "float radius")", 32},
        Case{
            R"("photonmap" "integer photons" 1000 "integer causticphotons" 400000 "integer nearest" 0 "float causticradius")",
            1}));

// A roughness that crosses gatheralpha from frame to frame: all frames together, each as it is alone, and none dark.
TEST(HiddenLight, StaysAsRoughnessCrossesTheThreshold) {
  constexpr int kFrames = 4;
  for (const char* estimator : {"kz11", "hj09"}) {
    const std::string integrator =
        fmt::format(R"("dsppm" "integer photons" 20000 "float radius" 0.6 "string estimator" "{}")", estimator);
    TestScene test(pane_over_metal(fmt::format("Frames {}", kFrames), integrator, kSun,
                                   metal(R"("float roughness@1" 0.2 "float roughness@4" 0.32)")));
    const auto scene = test.scene(test.all_frames());
    const auto together = test.integrator(*scene);
    for (int i = 0; i < 8; ++i) together->iterate({i, *scene});
    for (Frame f = 0; f < kFrames; ++f) {
      const double joint = mean_luminance(together->estimate(f));
      EXPECT_NEAR(joint / mean_luminance(test.render(FileFrame(f), 8)), 1, 2e-5);
      EXPECT_NEAR(joint / expected_radiance(2, 0.2 + 0.04 * f), 1, 0.03) << estimator << ", frame " << f + 1;
    }
  }
}

// The sun straight from above, cut off at x = -0.2 by a sheet: at the origin it is dark, and a disc of radius r reaches into
// the light with (acos(t) - t sqrt(1 - t^2)) / pi of its area, t = 0.2 / r. The radius starts with 0.6 and shrinks by
// r'^2 = r^2 (i + alpha) / (i + 1) after the i-th iteration [KZ11].
TEST(HiddenLight, IsGatheredWithinShrinkingDiscs) {
  constexpr int kIterations = 8;
  constexpr double kAlpha = 0.3;
  double lit = 0, r2 = 0.36;
  for (int i = 1; i <= kIterations; ++i) {
    const double t = 0.2 / std::sqrt(r2);
    lit += (std::acos(t) - t * std::sqrt(1 - t * t)) / kPiExact / kIterations;
    r2 *= (i + kAlpha) / (i + 1);
  }
  const Direction sun{0, 1};
  const double r = fresnel(1, 1.5), expected = 2 * (1 - r) / (1 + r) * ggx_reflection(sun, kToCamera, 0.2) * lit;
  for (const char* estimator : {"kz11", "hj09"}) {
    const std::string integrator = fmt::format(
        R"("dsppm" "string indirect" "photons" "integer photons" 100000 "float radius" 0.6 "float alpha" {} "string estimator" "{}")",
        kAlpha, estimator);
    TestScene scene(pane_over_metal("", integrator,
                                    R"("distant" "rgb L" [2 2 2] "point3 from" [0 0 1] "point3 to" [0 0 0])",
                                    metal(R"("float roughness" 0.2)")) +
                    R"(Material "diffuse" "rgb reflectance" [0 0 0]
Translate 0 0 0.2
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-.2 -2 0  2 -2 0  2 2 0  -.2 2 0])");
    EXPECT_NEAR(mean_luminance(scene.render(FileFrame(0), kIterations)) / expected, 1, 0.03) << estimator;
  }
}

// A coat over a black base: paths choose between the two, and are divided by the chance.
TEST(HiddenLight, OnACoat) {
  std::string text = pane_over_metal("", R"("dsppm" "integer photons" 4000 "float radius" 0.6)", kSun,
                                     R"("coateddiffuse" "rgb reflectance" [0 0 0] "float roughness" 0.2)");
  for (const char* axis : {"xresolution\" ", "yresolution\" "}) text.insert(text.find(axis) + 13, "2");
  const double r = fresnel(kToLight.z, 1.5);
  const double expected = 2 * kToLight.z * (1 - r) / (1 + r) * ggx_reflection(kToLight, kToCamera, 0.2, 1.5);
  TestScene scene(text);
  EXPECT_NEAR(mean_luminance(scene.render(FileFrame(0), 64)) / expected, 1, 0.04);
}

// Light that paths find by themselves is not brought once more: by way of two glossy walls, and from a lamp behind a pane.
TEST(HiddenLight, CountsOnce) {
  const std::string view = R"(
LookAt -1 1.2 -1.6  0.3 0.2 0.4  0 1 0
Camera "perspective" "float fov" 45
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
)";
  const std::string corner = view + R"(
LightSource "point" "rgb I" [1 1 1] "point3 from" [-0.3 0.8 -0.6]
Material "conductor" "float roughness" 0.04
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-2 0 -2  -2 0 1  2 0 1  2 0 -2]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-2 0 1  -2 2 1  2 2 1  2 0 1]
)";
  const std::string lamp = view + R"(
AttributeBegin
  Translate 0 2 0.6
  Rotate 90 1 0 0
  AreaLightSource "diffuse" "rgb L" [4 4 4]
  Shape "disk" "float radius" 0.7
AttributeEnd
Material "conductor" "float roughness" 0.04
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-2 0 -2  -2 0 2  2 0 2  2 0 -2]
Material "thindielectric"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-2 1.6 -2  -2 1.6 2  2 1.6 2  2 1.6 -2]
)";
  for (const std::string& scene : {corner, lamp}) {
    const test::Tiles path = test::rendered(R"(Integrator "path" "integer maxdepth" 6)" + scene, 32);
    for (const char* photons : {R"("dsppm" "integer photons" 1000)",
                                R"("photonmap" "integer photons" 1000 "integer causticphotons" 40000)"}) {
      const std::string integrator = fmt::format(R"(Integrator {} "integer maxdepth" 6)", photons);
      const test::Verdict verdict = test::agreement(test::rendered(integrator + scene, 16), path, {0.01 / 4, 0.003});
      EXPECT_TRUE(verdict.passed) << photons << ": " << verdict.message;
    }
  }
}

}  // namespace hidden_light_test
}  // namespace dspm
