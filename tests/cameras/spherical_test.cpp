// The camera that sees all around: its directions, its solid angles and where it sees a point.
#include <gtest/gtest.h>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/sampling.h"
#include "dspm/cameras/camera.h"
#include "tests/lights/params.h"
#include "tests/support/near.h"

namespace dspm {
namespace {

using namespace dspm::test;

std::unique_ptr<Camera> spherical(const std::string& mapping, int width, int height, const Matrix4& to_world = {}) {
  return make(camera_plugins(), "spherical", {text("mapping", mapping)},
              CameraContext{Transform(to_world), width, height});
}

void expect_direction(const Vec3& a, const Vec3& b) { expect_near(a, b, 2e-6f); }

TEST(Spherical, LooksWherePbrtLooks) {
  const auto seen = spherical("equirectangular", 400, 200);
  expect_direction(seen->ray({0, 100}, {}).direction, {1, 0, 0});
  expect_direction(seen->ray({100, 100}, {}).direction, {0, 0, 1});
  expect_direction(seen->ray({200, 100}, {}).direction, {-1, 0, 0});
  expect_direction(seen->ray({300, 100}, {}).direction, {0, 0, -1});
  expect_direction(seen->ray({37, 0}, {}).direction, {0, 1, 0});
  expect_direction(seen->ray({37, 200}, {}).direction, {0, -1, 0});
  const auto square = spherical("equalarea", 64, 64);
  expect_direction(square->ray({32, 32}, {}).direction, {0, 1, 0});
  expect_direction(square->ray({64, 32}, {}).direction, {1, 0, 0});
  expect_direction(square->ray({32, 64}, {}).direction, {0, 0, 1});
  expect_direction(square->ray({0, 0}, {}).direction, {0, -1, 0});
}

// A filter that reaches beyond an edge sees what adjoins there: directions change by little.
TEST(Spherical, GoesOnBeyondItsEdges) {
  for (const auto& [mapping, width, height] : {std::tuple{"equalarea", 200, 200}, {"equirectangular", 400, 200}}) {
    const auto seen = spherical(mapping, width, height);
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    for (float t = 0.05f; t < 1; t += 0.1f)
      for (const auto& [inside, outside] : {std::pair<Vec2, Vec2>{{.5f, t * h}, {-.5f, t * h}},
                                            {{w - .5f, t * h}, {w + .5f, t * h}},
                                            {{t * w, .5f}, {t * w, -.5f}},
                                            {{t * w, h - .5f}, {t * w, h + .5f}}})
        EXPECT_LT(length(seen->ray(inside, {}).direction - seen->ray(outside, {}).direction), 0.06f) << mapping;
  }
}

// Directions that are uniform over the sphere are seen with the density that sight() claims.
TEST(Spherical, SightIsTheInverse) {
  const Matrix4 to_world = Matrix4::translate(1, 2, 3) * Matrix4::rotate(30, 1, 2, 3) * Matrix4::scale(2, 2, 2);
  for (const auto& [mapping, width, height] : {std::tuple{"equalarea", 200, 200}, {"equirectangular", 400, 200}}) {
    const auto seen = spherical(mapping, width, height, to_world);
    int n = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      const PathRandom random(5, Stream::setup, i, 0);
      const Vec2 u = random.pair(0, 0), place{u.x * static_cast<float>(width), u.y * static_cast<float>(height)};
      const Ray ray = seen->ray(place, {});
      const auto sight = seen->sight(ray.at(7), {});
      if (!sight) continue;  // near an edge
      ++n;
      EXPECT_NEAR(sight->film.x, place.x, 0.02f) << mapping;
      EXPECT_NEAR(sight->film.y, place.y, 0.02f) << mapping;
      expect_near(sight->w, -ray.direction, 1e-5f);
      EXPECT_NEAR(sight->distance, 7, 1e-4f);
      const Basis across = Basis::around(sight->w);
      const auto moved = [&](const Vec3& d) {
        return (seen->sight(ray.at(7) + d * .02f, {})->film - seen->sight(ray.at(7) - d * .02f, {})->film) * 25;
      };
      if (!seen->sight(ray.at(7) + across.x * .02f, {}) || !seen->sight(ray.at(7) - across.x * .02f, {}) ||
          !seen->sight(ray.at(7) + across.y * .02f, {}) || !seen->sight(ray.at(7) - across.y * .02f, {}))
        continue;
      const Vec2 x = moved(across.x), y = moved(across.y);
      // Across the edges of the octahedron the square is folded; pixels there count for neither side.
      const float found = std::abs(x.x * y.y - x.y * y.x) / sight->pixels_per_area;
      if (std::string(mapping) == "equirectangular") {
        EXPECT_NEAR(found, 1, 0.02f);
      }
    }
    EXPECT_GT(n, 300) << mapping;
  }
}

// All pixels of the equal-area square have the same solid angle.
TEST(Spherical, EqualAreaPixelsHaveEqualSolidAngles) {
  const auto seen = spherical("equalarea", 200, 200);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto sight = seen->sight(2 * uniform_sphere(PathRandom(6, Stream::setup, i, 0).pair(0, 0)), {});
    if (sight) {
      EXPECT_NEAR(sight->pixels_per_area, 200 * 200 / (4 * kPi * 4), 0.1f);
    }
  }
  EXPECT_NEAR(seen->pixel_spacing(3), 3 * std::sqrt(4 * kPi) / 200, 1e-5f);
}

// A wide filter of a small picture reaches past several of its edges.
TEST(Spherical, GoesOnBeyondManyEdges) {
  const auto seen = spherical("equalarea", 8, 8);
  for (const float x : {-37.f, -9.f, 3.f, 11.f, 26.f})
    for (const float y : {-22.f, 2.f, 5.f, 30.f}) {
      const Vec3 here = seen->ray({x, y}, {}).direction, two_on = seen->ray({x + 16, y - 32}, {}).direction;
      EXPECT_NEAR(length(here), 1, 1e-5f) << x << " " << y;
      EXPECT_LT(length(here - two_on), 1e-4f) << x << " " << y;
    }
}

TEST(Spherical, ParametersThatPbrtIgnoresAreNoted) {
  EXPECT_EQ(errors_of(camera_plugins(), "spherical", {number("lensradius", 1)}, CameraContext{}),
            "parameter \"lensradius\" of plugin \"spherical\" has no effect, as in pbrt\n");
  EXPECT_NE(errors_of(camera_plugins(), "spherical", {text("mapping", "cube")}, CameraContext{}), "");
}

}  // namespace
}  // namespace dspm
