// Search radii: how both estimators shrink them, and what they are before they shrink.
//
// A beam's photons all land at one point of a wall, and pixels look straight at the wall at known distances from it. So
// a pixel finds all photons of an iteration or none, and its radiance tells the radius of every iteration.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace radius_test {

const double kPiD = std::acos(-1.);

/// [KZ11]: r_{i+1}^2 = r_i^2 (i + a) / (i + 1). So r_i^2 / r_1^2 = (1 + a) (2 + a) ... (i - 1 + a) / i!
///                = Gamma(i + a) / (Gamma(1 + a) i!).
double kz11_shrinkage(int i, double alpha) {
  return std::exp(std::lgamma(i + alpha) - std::lgamma(1 + alpha) - std::lgamma(i + 1.));
}

/// [HJ09]: R'^2 = R^2 (N + a M) / (N + M), N' = N + a M. After k times M photons N = k a M, so the next R'^2 / R^2 is
/// (k + 1) a / (k a + 1) = (k + 1) / (k + 1/a), and the product of k of them is k! Gamma(1/a) / Gamma(k + 1/a).
double hj09_shrinkage(int k, double alpha) {
  return std::exp(std::lgamma(k + 1.) + std::lgamma(1 / alpha) - std::lgamma(k + 1 / alpha));
}

TEST(IterationRadius, FollowsThePaper) {
  for (const float alpha : {0.3f, 0.7f, 0.9f}) {
    IterationRadius radius;
    for (int i = 1; i <= 1000; ++i) {
      const double expected = 0.25 * kz11_shrinkage(i, static_cast<double>(alpha));
      EXPECT_NEAR(static_cast<double>(radius.squared(0.5f)) / expected, 1, 1e-5) << "iteration " << i;
      radius.go_to(i, alpha);
    }
  }
}

constexpr int kPixels = 64;
constexpr double kSpacing = 0.25, kPower = 8, kAlbedo = 0.5;

/// Pixel i lies (i + 1/2) kSpacing from where the beam meets the wall. In frame 2 a mirror sends the beam away.
std::string beam(const std::string& integrator) {
  return fmt::format(R"(
Frames 2
Option "disablepixeljitter" true
Integrator {} "integer maxdepth" 1
Camera "orthographic" "float screenwindow" [0 {} {} {}]
Film "rgb" "integer xresolution" {} "integer yresolution" 1
WorldBegin
LightSource "spot" "point3 from" [0 0 1] "point3 to" [0 0 2] "float coneangle" .001 "float conedeltaangle" 0
  "float power" {}
DynamicBegin "mirror" "integer frames" [2 2]
  Material "conductor"
  Translate 0 0 1.5
  Shape "disk" "float radius" 0.1
DynamicEnd
Material "diffuse" "rgb reflectance" [{} {} {}]
Translate 0 0 2
Shape "disk" "float radius" 100
)",
                     integrator, kPixels * kSpacing, -kSpacing / 2, kSpacing / 2, kPixels, kPower, kAlbedo, kAlbedo,
                     kAlbedo);
}

struct Estimate {
  double radiance = 0;
  int lit = 0;  // iterations in which the pixel found photons
};

/// What n iterations make of a pixel at that distance: an iteration within whose radius r the beam lies gives albedo /
/// pi times power / (pi r^2), and nothing otherwise.
template <class Shrinkage>
Estimate expected(double distance, int n, double radius, Shrinkage&& shrinkage) {
  Estimate estimate;
  for (int i = 1; i <= n; ++i) {
    const double radius2 = radius * radius * shrinkage(i);
    if (distance * distance >= radius2) continue;
    estimate.radiance += kAlbedo / kPiD * kPower / (kPiD * radius2) / n;
    ++estimate.lit;
  }
  return estimate;
}

void expect_near(double value, double expected) { EXPECT_NEAR(value, expected, 1e-4 * expected); }

struct Settings {
  std::string integrator = {}, estimator = {}, parameters = {};
  int photons = 50;
  double alpha = 0.7, radius = 1;
  bool in_batches = false;  // of photons, with as little memory as does
};

std::unique_ptr<Integrator> integrator_of(TestScene& test, const Scene& scene, bool in_batches) {
  if (!in_batches) return test.integrator(scene);
  try {
    test.integrator(scene, {}, 1);
  } catch (const NotEnoughMemory& error) {
    return test.integrator(scene, {}, error.least.total());
  }
  return nullptr;
}

void expect_pixels(const Integrator& integrator, Frame frame, bool has_beam, int iterations, const Settings& s) {
  const Image image = integrator.estimate(frame);
  for (int x = 0; x < kPixels; ++x) {
    SCOPED_TRACE(fmt::format("pixel {} after {} iterations", x, iterations));
    const bool kz11 = s.estimator == "kz11";
    const Estimate pixel = !has_beam ? Estimate() : expected((x + 0.5) * kSpacing, iterations, s.radius, [&](int i) {
      return kz11 ? kz11_shrinkage(i, s.alpha) : hj09_shrinkage(i - 1, s.alpha);
    });
    expect_near(static_cast<double>(image.at(x, 0).g), pixel.radiance);
    const double radius = static_cast<double>(integrator.estimate(frame, "radius").at(x, 0).r);
    const double next = kz11 ? kz11_shrinkage(iterations + 1, s.alpha) : hj09_shrinkage(pixel.lit, s.alpha);
    expect_near(radius * radius, s.radius * s.radius * next);
    EXPECT_EQ(integrator.estimate(frame, "photons").at(x, 0).r, static_cast<float>(pixel.lit * s.photons));
  }
}

void expect_radii(const Settings& s) {
  Choices choices;
  choices.outputs = {"photons", "radius"};
  TestScene test(beam(fmt::format(R"("{}" "string emission" "power" "string estimator" "{}" "integer photons" {} {})",
                                  s.integrator, s.estimator, s.photons, s.parameters)),
                 choices);
  SCOPED_TRACE(s.integrator + " " + s.estimator + " " + s.parameters);
  for (const std::vector<FileFrame>& frames : test.intervals()) {
    const auto scene = test.scene(frames);
    const auto integrator = integrator_of(test, *scene, s.in_batches);
    if (frames.front() == FileFrame(0)) {  // in frame 2 alone there are no photons to save memory with
      EXPECT_EQ(integrator->statistics().photon_batches > 1, s.in_batches);
    }
    for (int n = 1; n <= 30; ++n) {
      integrator->iterate({n - 1, *scene});
      if (n > 3 && n != 10 && n != 30) continue;
      for (Frame j = 0; j < scene->frame_count(); ++j)
        expect_pixels(*integrator, j, frames[static_cast<std::size_t>(j)] == FileFrame(0), n, s);
    }
  }
}

class Radius : public testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  Settings settings() const {
    const auto [integrator, estimator] = GetParam();
    return {integrator, estimator};
  }
};

TEST_P(Radius, ShrinksAsThePaperSays) {
  for (const double alpha : {0.3, 0.9}) {
    Settings s = settings();
    s.alpha = alpha, s.radius = 12;
    s.parameters = fmt::format(R"("float radius" 12 "float alpha" {})", alpha);
    expect_radii(s);
  }
}

TEST_P(Radius, ShrinksAlikeWherePhotonsComeInBatches) {
  Settings s = settings();
  s.in_batches = true, s.photons = 8200;
  s.radius = 12, s.parameters = R"("float radius" 12 "string direct" "photons")";
  expect_radii(s);
}

TEST_P(Radius, IsFourPixelSpacingsAtFirst) {
  Settings s = settings();
  s.radius = 4 * kSpacing;
  expect_radii(s);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Radius,
                         testing::Combine(testing::Values("dsppm", "sppm"), testing::Values("kz11", "hj09")));

// No photon reaches what the camera sees, so hj09 keeps every pixel's first radius.
constexpr int kWidth = 24, kHeight = 16;

std::string dark(const std::string& integrator, double fov, const std::string& contents) {
  return fmt::format(R"(
Option "disablepixeljitter" true
Integrator {} "string estimator" "hj09" "integer photons" 10
Camera "perspective" "float fov" {}
Film "rgb" "integer xresolution" {} "integer yresolution" {}
WorldBegin
LightSource "spot" "point3 from" [0 2 0] "point3 to" [0 3 0] "float coneangle" .001 "float conedeltaangle" 0
)",
                     integrator, fov, kWidth, kHeight) +
         contents;
}

/// Calls fn(x, y on the plane z = 1 where the pixel's middle looks, its R2). `fov` is the angle over the height.
template <class Fn>
void for_each_first_radius2(const std::string& integrator, double fov, const std::string& contents, Fn&& fn) {
  TestScene test(dark(integrator, fov, contents));
  const auto scene = test.scene({FileFrame(0)});
  const auto made = test.integrator(*scene);
  made->iterate({0, *scene});
  const Image radii = made->estimate(0, "radius");
  const double spacing = 2 * std::tan(fov / 360 * kPiD) / kHeight;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      SCOPED_TRACE(fmt::format("{}, pixel {}, {}", integrator, x, y));
      fn((x + 0.5 - kWidth / 2) * spacing, (kHeight / 2 - y - 0.5) * spacing,
         std::pow(static_cast<double>(radii.at(x, y).r), 2));
    }
}

constexpr double kFov = 60;
const double kFourSpacings = 4 * 2 * std::tan(kFov / 360 * kPiD) / kHeight;  // at distance 1

// A floor at y = -1 up to the horizon: the ray through (x, y, 1) meets it at (x, y, 1) / -y. Half of the diagonal of
// the floor, 40 x 60, is the scene's radius.
TEST(FirstRadius, IsBoundedAtTheHorizon) {
  const double most = 0.05 * std::hypot(40, 60) / 2;
  for (const char* integrator : {R"("dsppm")", R"("sppm")"}) {
    int near = 0, far = 0, missed = 0;
    for_each_first_radius2(
        integrator, kFov,
        R"(Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-20 -1 0 20 -1 0 20 -1 60 -20 -1 60])",
        [&](double x, double y, double R2) {
          const bool hits = y < 0 && -1 / y < 60 && std::abs(x / y) < 20;
          const double radius = hits ? kFourSpacings * std::hypot(x, y, 1.) / -y : 0;
          ++(!hits ? missed : radius < most ? near : far);
          expect_near(R2, std::pow(std::min(radius, most), 2));
        });
    EXPECT_GT(near, 50);
    EXPECT_GT(far, 20);
    EXPECT_GT(missed, kWidth * kHeight / 2);
  }
}

/// A mirror at z = 5, and a wall behind the camera at z = -3: paths are 13 long for each unit along z.
constexpr const char* kMirrored = R"(
Material "conductor"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-200 -200 5 200 -200 5 200 200 5 -200 200 5]
Material "diffuse"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-200 -200 -3 200 -200 -3 200 200 -3 -200 200 -3])";

TEST(FirstRadius, CountsThePathByMirrors) {
  for_each_first_radius2(R"("dsppm")", kFov, kMirrored, [](double x, double y, double R2) {
    expect_near(R2, std::pow(kFourSpacings * 13 * std::hypot(x, y, 1.), 2));
  });
}

TEST(FirstRadius, StaysAboveRounding) {
  const double scene_radius = std::hypot(400, 400, 8) / 2;
  for_each_first_radius2(R"("dsppm")", 1e-5, kMirrored,
                         [&](double, double, double R2) { expect_near(R2, std::pow(1e-6 * scene_radius, 2)); });
}

TEST(FirstRadius, IsTheOneThatTheSceneGives) {
  for (const char* integrator : {R"("dsppm" "float radius" 0.37)", R"("sppm" "float radius" 0.37)"})
    for_each_first_radius2(integrator, kFov, kMirrored,
                           [](double, double, double R2) { expect_near(R2, 0.37 * 0.37); });
}

}  // namespace radius_test
}  // namespace dspm::test
