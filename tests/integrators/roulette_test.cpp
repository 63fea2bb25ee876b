// Camera paths that go on for longer than roulette spares them: what is seen by way of many mirrors is known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "dspm/testing/agreement.h"

namespace dspm::test {
namespace roulette_test {

class Roulette : public testing::TestWithParam<const char*> {
 protected:
  static std::string integrator(int max_depth) {
    return fmt::format("Integrator {} \"integer maxdepth\" {}\n", GetParam(), max_depth);
  }
};

// From the middle of a mirror ball that glows with radiance 1 inside, every ray returns along a diameter, and each
// arrival adds the glow times what all reflections before have left: with at most n of them
//   L = 1 + r + ... + r^n = (1 - r^(n+1)) / (1 - r).
TEST_P(Roulette, MirrorsAroundTheEye) {
  const float reflectance[] = {0.8f, 0.5f, 0.3f};
  for (const int n : {4, 6, 30}) {
    Rgb expected;
    for (int c = 0; c < 3; ++c)
      expected[c] = (1 - std::pow(reflectance[c], static_cast<float>(n + 1))) / (1 - reflectance[c]);
    const Tiles tiles = rendered(integrator(n) + R"(
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
ReverseOrientation
AreaLightSource "diffuse" "rgb L" [1 1 1]
Material "conductor" "rgb reflectance" [0.8 0.5 0.3]
Shape "sphere" "float radius" 2)",
                                 8);
    const Verdict verdict = agreement(tiles, expected);
    EXPECT_TRUE(verdict.passed) << "at most " << n << " reflections: " << verdict.message;
  }
}

/// Of a metal with the index 1 + ik, unpolarised, at 45 degrees: from Snell's law sin = n sin_t with complex angles.
double reflectance_at_45(double normal_reflectance) {
  const std::complex<double> n(1, 2 * std::sqrt(normal_reflectance / (1 - normal_reflectance)));
  const double cos = std::sqrt(0.5);
  const std::complex<double> cos_t = std::sqrt(1. - 0.5 / (n * n));
  const auto perpendicular = std::norm((cos - n * cos_t) / (cos + n * cos_t));
  const auto parallel = std::norm((n * cos - cos_t) / (n * cos + cos_t));
  return (perpendicular + parallel) / 2;
}

// Two mirrors face one another at a distance of 1. Parallel rays at 45 degrees meet one after every unit of their way
// along them, at 0.5, 1.5, ..., 6.5, and then the lamp across the end at 7: all that is seen was mirrored seven times.
TEST_P(Roulette, LampAtTheEndOfACorridorOfMirrors) {
  const double r = reflectance_at_45(0.7);
  const Tiles tiles = rendered(integrator(12) + R"(
LookAt 0 0 0  1 0 1  0 1 0
Camera "orthographic" "float screenwindow" [-.1 .1 -.1 .1]
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
Material "conductor" "rgb reflectance" [.7 .7 .7]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-.5 -1 -1 -.5 1 -1 -.5 1 8 -.5 -1 8]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [.5 -1 -1 .5 1 -1 .5 1 8 .5 -1 8]
Translate 0 0 7
AreaLightSource "diffuse" "rgb L" [20 20 20] "bool twosided" true
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "disk" "float radius" 2)",
                               8);
  const Verdict verdict = agreement(tiles, Rgb(static_cast<float>(20 * std::pow(r, 7))));
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

INSTANTIATE_TEST_SUITE_P(Integrators, Roulette,
                         testing::Values(R"("path")", R"("sppm" "integer photons" 100)",
                                         R"("dsppm" "integer photons" 100 "string estimator" "hj09")",
                                         R"("dsppm" "integer photons" 100 "string direct" "sampled")",
                                         R"("photonmap" "integer photons" 100 "integer causticphotons" 100)",
                                         R"("vcm" "integer photons" 100)"));

}  // namespace roulette_test
}  // namespace dspm::test
