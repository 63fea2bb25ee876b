// Rays of the cameras against what geometry says, and against pbrt's chain of matrices.
#include <gtest/gtest.h>

#include "dspm/base/math/rng.h"
#include "dspm/cameras/camera.h"
#include "tests/lights/params.h"
#include "tests/support/near.h"

namespace dspm {
namespace {

using namespace dspm::test;

CameraContext film(int width, int height, const Matrix4& to_world = {}) { return {Transform(to_world), width, height}; }

std::unique_ptr<Camera> camera(const std::string& name, const std::vector<Param>& params,
                               const CameraContext& context) {
  return make(camera_plugins(), name, params, context);
}

Param integer(std::string name, int value) {
  return {ParamType::integer, std::move(name), {}, std::vector<int>{value}, {}, {}};
}

TEST(Perspective, FieldOfViewIsOverTheShorterAxis) {
  const auto wide = camera("perspective", {}, film(400, 200));
  expect_near(wide->ray({200, 100}, {}).direction, {0, 0, 1});
  expect_near(wide->ray({200, 0}, {}).direction, normalize({0, 1, 1}));
  expect_near(wide->ray({0, 100}, {}).direction, normalize({-2, 0, 1}));
  expect_near(wide->ray({400, 200}, {}).direction, normalize({2, -1, 1}));
  const auto tall = camera("perspective", {number("fov", 60)}, film(200, 400));
  const float t = std::tan(kPi / 6);
  expect_near(tall->ray({200, 200}, {}).direction, normalize({t, 0, 1}));
  expect_near(tall->ray({100, 400}, {}).direction, normalize({0, -2 * t, 1}));
}

TEST(Perspective, AspectAndScreenWindowAreAsGiven) {
  const auto square = camera("perspective", {number("frameaspectratio", 1)}, film(400, 200));
  expect_near(square->ray({0, 0}, {}).direction, normalize({-1, 1, 1}));
  const auto shifted = camera("perspective", {numbers("screenwindow", {0, 1, -0.5f, 2})}, film(400, 200));
  expect_near(shifted->ray({0, 0}, {}).direction, normalize({0, 2, 1}));
  expect_near(shifted->ray({400, 200}, {}).direction, normalize({1, -0.5f, 1}));
  const auto mirrored = camera("perspective", {numbers("screenwindow", {1, -1, -1, 1})}, film(400, 200));
  expect_near(mirrored->ray({0, 0}, {}).direction, normalize({1, 1, 1}));
}

TEST(Perspective, LooksLeftHandedAlongLookAt) {
  const Matrix4 to_world = Matrix4::look_at({{1, 2, -5}}, {{1, 2, 0}}, {{0, 1, 0}})->inverse().value();
  const auto seen = camera("perspective", {}, film(100, 100, to_world));
  const Ray ray = seen->ray({100, 50}, {});  // the right edge
  expect_near(ray.origin, {1, 2, -5});
  expect_near(ray.direction, normalize({1, 0, 1}));
  const auto mirrored = camera("perspective", {}, film(100, 100, Matrix4::scale(-1, 1, 1)));
  expect_near(mirrored->ray({100, 50}, {}).direction, normalize({-1, 0, 1}));
}

using Row = std::array<double, 4>;

Row apply(const Matrix4& m, const Row& v) {
  Row r{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) r[i] += m.m[i][j] * v[j];
  return r;
}

// Raster to screen by translation and scales; screen to camera by the inverse of the projection with near plane 0.01
// and far plane 1000. [Pharr, Jakob, Humphreys, 5.2]
Vec3 direction_by_matrices(double fov, double aspect, int width, int height, Vec2 film_point) {
  const double x = std::max(aspect, 1.), y = std::max(1 / aspect, 1.), near = 0.01, far = 1000;
  const Matrix4 screen_from_raster =
      Matrix4::translate(-x, y, 0) * Matrix4::scale(2 * x, -2 * y, 1) * Matrix4::scale(1. / width, 1. / height, 1);
  Matrix4 projection;
  projection.m = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, far / (far - near), -far * near / (far - near)}, {0, 0, 1, 0}}};
  const double inverse_tan = 1 / std::tan(fov * std::acos(-1.) / 360);
  const Matrix4 screen_from_camera = Matrix4::scale(inverse_tan, inverse_tan, 1) * projection;
  const Row p = apply(screen_from_camera.inverse().value() * screen_from_raster,
                      {static_cast<double>(film_point.x), static_cast<double>(film_point.y), 0, 1});
  const double l = std::hypot(p[0], p[1], p[2]) * (p[3] < 0 ? -1 : 1);
  return {static_cast<float>(p[0] / l), static_cast<float>(p[1] / l), static_cast<float>(p[2] / l)};
}

TEST(Perspective, AgreesWithPbrtsMatrices) {
  for (int i = 0; i < 200; ++i) {
    const PathRandom random(1, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const int width = 1 + static_cast<int>(random.number(0, 0) * 2000),
              height = 1 + static_cast<int>(random.number(0, 1) * 2000);
    const float fov = 1 + 170 * random.number(0, 2);
    const Vec2 u = random.pair(0, 3), p{u.x * static_cast<float>(width), u.y * static_cast<float>(height)};
    const auto seen = camera("perspective", {number("fov", fov)}, film(width, height));
    expect_near(seen->ray(p, {}).direction,
                direction_by_matrices(static_cast<double>(fov), static_cast<double>(width) / height, width, height, p),
                2e-6f);
  }
}

// All rays of a pixel through the lens meet where its central ray meets the plane of focus, and fill the lens evenly.
void expect_sharp(const std::string& name, Vec2 film_point) {
  const auto pinhole = camera(name, {}, film(300, 200));
  const auto lens = camera(name, {number("lensradius", 0.5f), number("focaldistance", 4)}, film(300, 200));
  const Ray central = pinhole->ray(film_point, {});
  const Vec3 focus = central.at(4 / central.direction.z);
  Vec3 sum;
  float sum_of_squares = 0;
  constexpr int n = 10'000;
  for (int i = 0; i < n; ++i) {
    const Vec2 u = PathRandom(2, Stream::setup, static_cast<std::uint64_t>(i), 0).pair(0, 0);
    const Ray ray = lens->ray(film_point, u);
    EXPECT_NEAR(length(ray.direction), 1, 1e-6f);
    EXPECT_EQ(ray.origin.z, 0);
    expect_near(ray.at((4 - ray.origin.z) / ray.direction.z), focus, 5e-6f);
    const Vec3 offset = ray.origin - central.origin;
    EXPECT_LE(length(offset), 0.5f * 1.000001f);
    sum += offset;
    sum_of_squares += length2(offset);
  }
  // Uniform over a disk: mean 0 with deviation r / 2 a coordinate, mean square r^2 / 2 with deviation r^2 / sqrt(12).
  const float sigma = 0.5f / 2 / std::sqrt(float{n});
  EXPECT_LT(std::abs(sum.x / n), 5 * sigma);
  EXPECT_LT(std::abs(sum.y / n), 5 * sigma);
  EXPECT_NEAR(sum_of_squares / n, 0.125f, 5 * 0.25f / std::sqrt(12.f * n));
}

TEST(Perspective, IsSharpInThePlaneOfFocus) { expect_sharp("perspective", {40, 170}); }
TEST(Orthographic, IsSharpInThePlaneOfFocus) { expect_sharp("orthographic", {40, 170}); }

// A regular polygon with n corners at the distance R, evenly filled: the mean of r^2 is R^2 / 6 (1 + 2 cos^2(pi / n)).
TEST(Blades, FillAPolygonEvenly) {
  constexpr int n = 20'000;
  constexpr float radius = 0.5f, ratio = 2;
  for (const std::string name : {"perspective", "orthographic"})
    for (const int blades : {3, 6}) {
      const auto lens = camera(name,
                               {number("lensradius", radius), number("focaldistance", 4), integer("blades", blades),
                                number("bladerotation", 20), number("anamorphic", ratio)},
                               film(300, 200));
      const Vec3 middle = camera(name, {}, film(300, 200))->ray({40, 170}, {}).origin;
      const float edge = std::cos(kPi / static_cast<float>(blades));
      float x2 = 0, y2 = 0, farthest = 0;
      Vec2 sum;
      for (int i = 0; i < n; ++i) {
        const Vec2 u = PathRandom(2, Stream::setup, static_cast<std::uint64_t>(i), 0).pair(0, 0);
        const Vec3 offset = lens->ray({40, 170}, u).origin - middle;
        const Vec2 p{offset.x * ratio / radius, offset.y / radius};  // as if the opening were not narrower than high
        for (int k = 0; k < blades; ++k) {
          const float angle = (20 + 360.f * static_cast<float>(k) / static_cast<float>(blades)) * kPi / 180;
          farthest = std::max(farthest, p.x * std::cos(angle) + p.y * std::sin(angle));
        }
        x2 += p.x * p.x, y2 += p.y * p.y, sum = sum + p;
      }
      EXPECT_NEAR(farthest, edge, 0.02f) << name << blades;
      EXPECT_LE(farthest, edge * 1.00001f) << name << blades;
      const float expected = (1 + 2 * edge * edge) / 12;  // of each axis, by symmetry
      EXPECT_NEAR(x2 / n, expected, 5 * 0.5f / std::sqrt(float{n})) << name << blades;
      EXPECT_NEAR(y2 / n, expected, 5 * 0.5f / std::sqrt(float{n})) << name << blades;
      EXPECT_LT(std::hypot(sum.x, sum.y) / n, 5 * 0.7f / std::sqrt(float{n})) << name << blades;
    }
}

TEST(Orthographic, RaysAreParallelAndSpreadOverTheScreen) {
  const Matrix4 to_world = Matrix4::translate(0, 0, 3) * Matrix4::scale(2, 2, 2);
  const auto seen = camera("orthographic", {}, film(200, 100, to_world));
  for (const Vec2 p : {Vec2{0, 0}, Vec2{100, 50}, Vec2{200, 100}, Vec2{13, 77}}) {
    const Ray ray = seen->ray(p, {});
    expect_near(ray.direction, {0, 0, 1});
    expect_near(ray.origin, {2 * (p.x / 50 - 2), 2 * (1 - p.y / 50), 3}, 2e-6f);
  }
  const auto window = camera("orthographic", {numbers("screenwindow", {-3, 5, 0, 1})}, film(200, 100));
  expect_near(window->ray({0, 100}, {}).origin, {-3, 0, 0});
  expect_near(window->ray({200, 0}, {}).origin, {5, 1, 0});
}

TEST(PixelSpacing, IsTheDistanceOfNeighbouringRays) {
  const Matrix4 to_world = Matrix4::translate(1, 2, 3) * Matrix4::rotate(30, 1, 2, 3) * Matrix4::scale(3, 3, 3);
  for (const std::string name : {"perspective", "orthographic"}) {
    const auto seen = camera(name, {number("frameaspectratio", 3)}, film(640, 480, to_world));  // pixels are not square
    for (const float t : {0.5f, 40.f}) {
      const Vec3 at = seen->ray({320, 240}, {}).at(t);
      const float across = length(seen->ray({321, 240}, {}).at(t) - at),
                  down = length(seen->ray({320, 241}, {}).at(t) - at);
      EXPECT_NEAR(seen->pixel_spacing(t) / std::sqrt(across * down), 1, 1e-3f) << name << " at " << t;
    }
  }
}

TEST(Sight, FindsTheRayAgainAndTheFilmThatAnAreaTakes) {
  const Matrix4 to_world = Matrix4::translate(1, 2, 3) * Matrix4::rotate(30, 1, 2, 3) * Matrix4::scale(3, 2, 1.5);
  for (const std::string name : {"perspective", "orthographic"}) {
    for (const float lens_radius : {0.f, 0.2f}) {
      const auto seen =
          camera(name, {number("lensradius", lens_radius), number("focaldistance", 5), integer("blades", 5)},
                 film(640, 480, to_world));
      for (std::uint64_t i = 0; i < 200; ++i) {
        const PathRandom random(4, Stream::setup, i, 0);
        const Vec2 u = random.pair(0, 0), lens = random.pair(0, 1), place{u.x * 640, u.y * 480};
        const Ray ray = seen->ray(place, lens);
        const Vec3 p = ray.at(1 + 30 * random.number(0, 2));
        const auto sight = seen->sight(p, lens);
        ASSERT_TRUE(sight) << name;
        EXPECT_NEAR(sight->film.x, place.x, 0.02f) << name;
        EXPECT_NEAR(sight->film.y, place.y, 0.02f) << name;
        expect_near(sight->w, -ray.direction, 1e-5f);
        EXPECT_NEAR(sight->distance / length(p - ray.origin), 1, 1e-5f);
        const Basis across = Basis::around(sight->w);
        const float step = 0.02f * sight->distance;
        const auto moved = [&](const Vec3& d) {
          return (seen->sight(p + d * step, lens)->film - seen->sight(p - d * step, lens)->film) * (0.5f / step);
        };
        const Vec2 x = moved(across.x), y = moved(across.y);
        EXPECT_NEAR(std::abs(x.x * y.y - x.y * y.x) / sight->pixels_per_area, 1, 0.01f) << name;
      }
    }
  }
}

TEST(Sight, NothingBehindTheCameraOrInItsPlane) {
  for (const std::string name : {"perspective", "orthographic"})
    for (const float z : {-1.f, 0.f})
      EXPECT_FALSE(camera(name, {}, film(64, 64))->sight({0.1f, 0, z}, {})) << name << " at " << z;
}

TEST(Cameras, RejectWhatMakesNoSense) {
  const CameraContext context = film(10, 10);
  const auto errors = [&](Param p) { return errors_of(camera_plugins(), "perspective", {std::move(p)}, context); };
  EXPECT_EQ(errors(number("fov", 180)), "parameter \"fov\" of plugin \"perspective\" must be below 180\n");
  EXPECT_EQ(errors(number("fov", 0)), "parameter \"fov\" of plugin \"perspective\" must be above 0\n");
  EXPECT_EQ(errors(number("lensradius", -1)),
            "parameter \"lensradius\" of plugin \"perspective\" must not be negative\n");
  EXPECT_EQ(errors(number("focaldistance", 0)),
            "parameter \"focaldistance\" of plugin \"perspective\" must be above 0\n");
  EXPECT_EQ(errors(integer("blades", 2)),
            "parameter \"blades\" of plugin \"perspective\" must be 0, or from 3 to 100\n");
  EXPECT_EQ(errors(number("anamorphic", 0)), "parameter \"anamorphic\" of plugin \"perspective\" must be above 0\n");
  EXPECT_NE(errors(numbers("screenwindow", {-1, 1, -1})), "");
  EXPECT_NE(errors(numbers("screenwindow", {1, 1, -1, 1})), "");
  EXPECT_EQ(errors(number("shutterclose", 0.5f)), "");
  EXPECT_NE(errors(number("fovv", 1)), "");
}

TEST(Cameras, DescribeTheirParameters) {
  for (const auto& plugin : camera_plugins()) {
    const auto described = describe(plugin, CameraContext{});
    EXPECT_GE(described.size(), 3u) << plugin.name;
  }
}

}  // namespace
}  // namespace dspm
