// Lenses against the formulas of textbooks: surfaces that image a point perfectly, thick lenses, pupils.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/sampling.h"
#include "dspm/cameras/exit_pupil.h"
#include "dspm/cameras/lens_file.h"

namespace dspm {
namespace {

constexpr float kRadius = 0.02f, kIndex = 1.5f;

// A point within a ball of glass, R/n from its middle, seems to lie n R from it, whichever way the light goes: the
// aplanatic points of a sphere. [Born and Wolf, Principles of Optics, 4.2.3]
TEST(Lens, AplanaticPointsOfASphere) {
  const LensSystem ball({{kRadius, kRadius * (1 + 1 / kIndex), kIndex, 0.95f * kRadius}});
  const Vec3 image{0, 0, kRadius / kIndex - kIndex * kRadius};
  int passed = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Vec3 w = uniform_cone(PathRandom(1, Stream::setup, i, 0).pair(0, 0), 0.5f);
    const auto out = ball.from_film({{}, w});
    if (!out) continue;
    ++passed;
    const Vec3 from_image = out->ray.origin - image;
    EXPECT_LT(length(cross(from_image, out->ray.direction)), 2e-6f * length(from_image) + 1e-8f);
    EXPECT_NEAR(length(out->ray.origin - Vec3{0, 0, kRadius / kIndex}), kRadius, 1e-7f);
    EXPECT_NEAR(length(out->ray.direction), 1, 1e-6f);
  }
  EXPECT_GT(passed, 200);
}

/// A bulge on either side.
LensSystem biconvex(float front, float rear, float thickness, float aperture, float to_film) {
  return LensSystem({{front, thickness, kIndex, aperture}, {-rear, to_film, 1, aperture}});
}

// 1/f = (n - 1) (1/a + 1/b - (n - 1) t / (n a b)), and the focal points lie f (1 - (n - 1) t / (n R)) from the vertices,
// with the radius on the other side. [Hecht, Optics, 6.1]
TEST(Lens, ThickLensHasItsCardinalPoints) {
  const float a = 0.04f, b = 0.07f, t = 0.012f, n = kIndex, to_film = 0.03f;
  const float f = 1 / ((n - 1) * (1 / a + 1 / b - (n - 1) * t / (n * a * b)));
  const auto lens = biconvex(a, b, t, 0.01f, to_film).thick_lens();
  ASSERT_TRUE(lens);
  EXPECT_NEAR(lens->focal_length / f, 1, 1e-4f);
  EXPECT_NEAR(lens->film_principal, to_film - f * (1 - (n - 1) * t / (n * a)) + f, 1e-5f);
  EXPECT_NEAR(lens->scene_principal, to_film + t + f * (1 - (n - 1) * t / (n * b)) - f, 1e-5f);
}

// A ball's principal planes go through its middle, and f = n R / (2 (n - 1)).
TEST(Lens, BallIsAThinLensInItsMiddle) {
  const auto lens = biconvex(kRadius, kRadius, 2 * kRadius, 0.005f, 0.05f).thick_lens();
  ASSERT_TRUE(lens);
  EXPECT_NEAR(lens->focal_length / (kIndex * kRadius / (2 * (kIndex - 1))), 1, 1e-4f);
  EXPECT_NEAR(lens->film_principal, 0.05f + kRadius, 1e-5f);
  EXPECT_NEAR(lens->scene_principal, 0.05f + kRadius, 1e-5f);
}

// Two thin lenses: 1/f = 1/f1 + 1/f2 - d / (f1 f2). The radii are much larger than the apertures.
TEST(Lens, TwoThinLensesAdd) {
  const float f1 = 0.1f, f2 = 0.06f, d = 0.02f, thin = 1e-6f;
  const auto radius = [](float f) { return 2 * (kIndex - 1) * f; };
  const LensSystem pair({{radius(f1), thin, kIndex, 0.01f},
                         {-radius(f1), d, 1, 0.01f},
                         {radius(f2), thin, kIndex, 0.01f},
                         {-radius(f2), 0.05f, 1, 0.01f}});
  const auto lens = pair.thick_lens();
  ASSERT_TRUE(lens);
  EXPECT_NEAR(lens->focal_length * (1 / f1 + 1 / f2 - d / (f1 * f2)), 1, 1e-3f);
}

// What passes one way passes the other way on the same line.
TEST(Lens, PathsAreReversible) {
  const LensSystem lens({{0.03f, 0.006f, 1.6f, 0.012f},
                         {0.2f, 0.004f, 1, 0.012f},
                         {0, 0.004f, 0, 0.006f},
                         {-0.05f, 0.003f, 1.7f, 0.01f},
                         {-0.02f, 0.045f, 1, 0.01f}});
  int passed = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const PathRandom random(2, Stream::setup, i, 0);
    const Vec2 film = concentric_disk(random.pair(0, 0)) * 0.01f, rear = concentric_disk(random.pair(0, 1)) * 0.01f;
    const Vec3 from{film.x, film.y, 0};
    const auto out = lens.from_film({from, Vec3{rear.x, rear.y, lens.rear_z()} - from});
    if (!out) continue;
    ++passed;
    const auto back = lens.from_scene({out->ray.at(0.1f), -out->ray.direction});
    ASSERT_TRUE(back);
    const Vec3 at_film = back->at(-back->origin.z / back->direction.z);
    EXPECT_LT(length(at_film - from), 1e-6f);
  }
  EXPECT_GT(passed, 100);
}

TEST(Lens, IsFocusedByItsDistances) {
  for (const float distance : {0.5f, 1.f, 20.f}) {
    LensSystem lens = biconvex(0.05f, 0.05f, 0.004f, 0.01f, 0.05f);
    const float to_film = lens.focus(distance);
    const auto thick = lens.thick_lens();
    ASSERT_TRUE(thick);
    EXPECT_NEAR(to_film, thick->film_principal, 1e-6f);
    EXPECT_NEAR((1 / to_film + 1 / (distance - thick->scene_principal)) * thick->focal_length, 1, 1e-4f);
  }
  LensSystem close = biconvex(0.05f, 0.05f, 0.004f, 0.01f, 0.05f);
  EXPECT_THROW(close.focus(0.1f), std::runtime_error);
  LensSystem hollow({{-0.05f, 0.004f, kIndex, 0.01f}, {0.05f, 0.05f, 1, 0.01f}});
  EXPECT_THROW(hollow.focus(2), std::runtime_error);
  LensSystem stop_only({{0, 0.05f, 1, 0.01f}});
  EXPECT_THROW(stop_only.focus(2), std::runtime_error);
}

/// What the pupil's samples find of the integral of what passes over the plane of the rear vertex, per area.
float passing_area(const LensSystem& lens, const ExitPupil& pupil, Vec2 film, int side) {
  double sum = 0;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 u{(static_cast<float>(i % side) + 0.5f) / static_cast<float>(side),
                 (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side)};
    const auto sample = pupil.sample(film, u);
    if (!sample) return 0;
    const Vec3 from{film.x, film.y, 0};
    if (const auto passage = lens.from_film({from, sample->p - from}))
      sum += static_cast<double>(passage->share * sample->area);
  }
  return static_cast<float>(sum / (side * side));
}

// Two round holes, seen from the film, are two circles in the plane of the nearer one; light passes where they overlap.
// Glass of index 1 bends nothing.
TEST(ExitPupil, TwoHolesVignetteAsTwoCirclesOverlap) {
  const float near = 0.04f, far = 0.09f, r = 0.01f;
  const LensSystem holes({{100, far - near, 1, r}, {100, near, 1, r}});
  const ExitPupil pupil(holes, 0.03f);
  const double scale = static_cast<double>(near) / static_cast<double>(far), r1 = static_cast<double>(r),
               r2 = r1 * scale;
  for (const float x : {0.f, 0.004f, 0.009f, 0.014f, 0.019f, 0.024f}) {
    const double d = static_cast<double>(x) * (1 - scale);
    double overlap = 0;
    if (d <= r1 - r2) {
      overlap = std::numbers::pi * r2 * r2;
    } else if (d < r1 + r2) {
      const double a = (d * d + r1 * r1 - r2 * r2) / (2 * d), b = d - a;
      overlap = r1 * r1 * std::acos(a / r1) - a * std::sqrt(r1 * r1 - a * a) + r2 * r2 * std::acos(b / r2) -
                b * std::sqrt(r2 * r2 - b * b);
    }
    // The same all around the axis.
    for (const float angle : {0.f, 1.f, 2.5f})
      EXPECT_NEAR(passing_area(holes, pupil, {x * std::cos(angle), x * std::sin(angle)}, 150), overlap,
                  5e-3 * std::numbers::pi * r2 * r2)
          << x;
  }
}

// Boxes lose nothing: a brute force search through the whole rear finds no more light.
TEST(ExitPupil, BoxesHoldAllThatPasses) {
  for (const float stop : {0.008f, 0.0005f}) {
    const LensSystem lens({{0.03f, 0.006f, 1.6f, 0.012f},
                           {0.2f, 0.004f, 1, 0.012f},
                           {0, 0.004f, 0, stop},
                           {-0.05f, 0.003f, 1.7f, 0.01f},
                           {-0.02f, 0.045f, 1, 0.01f}});
    const ExitPupil pupil(lens, 0.022f);
    for (float x = 0; x < 0.022f; x += 0.0043f) {
      const float found = passing_area(lens, pupil, {x, 0}, 200), reach = 1.5f * lens.rear_aperture();
      const int side = stop > 0.001f ? 200 : 600;
      int passed = 0;
      for (int i = 0; i < side * side; ++i) {
        const Vec3 p{reach * (2 * (static_cast<float>(i % side) + 0.5f) / static_cast<float>(side) - 1),
                     reach * (2 * (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side) - 1), lens.rear_z()};
        passed += lens.from_film({{x, 0, 0}, p - Vec3{x, 0, 0}}).has_value();
      }
      const float all = 4 * reach * reach * static_cast<float>(passed) / static_cast<float>(side * side);
      EXPECT_NEAR(found, all, 0.02f * kPi * stop * stop) << stop << " at " << x;
    }
  }
}

TEST(Diaphragms, LetAsMuchThroughAsACircle) {
  Image picture(7, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) picture.at(x, y) = Rgb(static_cast<float>(y == 0), static_cast<float>(x % 2), 0.25f);
  std::vector<std::pair<std::string, Diaphragm>> all{{"circle", {}}, {"picture", Diaphragm::of(picture)}};
  for (const std::string name : {"gaussian", "square", "pentagon", "star"})
    all.emplace_back(name, Diaphragm::named(name).value());
  constexpr int kSide = 500;
  for (const auto& [name, diaphragm] : all) {
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i)
      sum += static_cast<double>(diaphragm.share({1.4f * (2 * (static_cast<float>(i % kSide) + 0.5f) / kSide - 1),
                                                  1.4f * (2 * (static_cast<float>(i / kSide) + 0.5f) / kSide - 1)}));
    EXPECT_NEAR(sum * 4 * 1.4 * 1.4 / (kSide * kSide), std::numbers::pi, 0.03) << name;
  }
}

TEST(Diaphragms, StandAsInPbrt) {
  const Diaphragm pentagon = Diaphragm::named("pentagon").value(), star = Diaphragm::named("star").value();
  EXPECT_GT(pentagon.share({0, -0.79f}), 0);  // a corner
  EXPECT_EQ(pentagon.share({0, 0.7f}), 0);    // an edge, at 0.65
  EXPECT_GT(star.share({-0.99f, 0}), 0);      // a point
  EXPECT_EQ(star.share({0.4f, 0}), 0);        // between two, at 0.38
  Image upper(2, 2);
  upper.at(0, 0) = Rgb(1);
  const Diaphragm picture = Diaphragm::of(upper);
  EXPECT_GT(picture.share({-0.5f, 0.5f}), 0);
  EXPECT_EQ(picture.share({0.5f, 0.5f}), 0);
  EXPECT_EQ(picture.share({-0.5f, -0.5f}), 0);
  EXPECT_FALSE(Diaphragm::named("hexagon"));
  EXPECT_THROW(Diaphragm::of(Image(3, 3)), std::runtime_error);
}

TEST(LensFiles, AreReadAndConvertedToMetres) {
  const auto lens = parse_lens("# a stop\n 20 +4 1.5 10 # glass\r\n0 3 0 8\n-1e3\t50 1 12");
  ASSERT_EQ(lens.size(), 3u);
  EXPECT_FLOAT_EQ(lens[0].curvature, 0.02f);
  EXPECT_FLOAT_EQ(lens[0].thickness, 0.004f);
  EXPECT_FLOAT_EQ(lens[0].eta, 1.5f);
  EXPECT_FLOAT_EQ(lens[0].aperture, 0.005f);
  EXPECT_EQ(lens[1].curvature, 0);
  EXPECT_FLOAT_EQ(lens[2].curvature, -1);
}

std::string error_of(std::string_view text) {
  try {
    parse_lens(text);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return {};
}

TEST(LensFiles, BadOnesAreRefused) {
  EXPECT_EQ(error_of(""), "it has 0 numbers, but a lens has four for each of its surfaces");
  EXPECT_EQ(error_of("# only words"), "it has 0 numbers, but a lens has four for each of its surfaces");
  EXPECT_EQ(error_of("20 4 1.5 10 20"), "it has 5 numbers, but a lens has four for each of its surfaces");
  EXPECT_EQ(error_of("20 4 1.5 ten"), "\"ten\" is no number that a lens has");
  EXPECT_EQ(error_of("20 4 1.5x 10"), "\"1.5x\" is no number that a lens has");
  EXPECT_EQ(error_of("nan 4 1.5 10"), "\"nan\" is no number that a lens has");
  EXPECT_EQ(error_of("1e30 4 1.5 10"), "\"1e30\" is no number that a lens has");
  EXPECT_EQ(error_of("20 4 1.5 10  20 4 1 0"), "surface 2 has no aperture");
  EXPECT_EQ(error_of("20 -4 1.5 10"), "surface 1 has a thickness or an index below 0");
  EXPECT_EQ(error_of("20 4 15 10"), "surface 1 has an index of 15");
  std::string many;
  for (int i = 0; i < 300; ++i) many += "20 4 1.5 10\n";
  EXPECT_EQ(error_of(many), "it has more than 200 surfaces");
}

}  // namespace
}  // namespace dspm
