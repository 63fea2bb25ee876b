// The camera with a lens of glass against a thin lens, and its weights against the irradiance that a lens makes.
#include <gtest/gtest.h>

#include <numbers>

#include "dspm/base/math/rng.h"
#include "dspm/cameras/camera.h"
#include "dspm/image/png.h"
#include "tests/lights/params.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

using namespace dspm::test;

// Two equal bulges, and a stop close behind them. 1/f = (n - 1) (2/R - (n - 1) t / (n R^2)), and the principal planes
// lie f (n - 1) t / (n R) within the glass. [Hecht, Optics, 6.1]
constexpr const char* kBulges = "50 1 1.5 20\n-50 .01 1 20\n0 50 0 20\n";
constexpr float kFocalLength = 0.05f * 3 / (3 - 0.01f), kPrincipal = kFocalLength / 150,
                kBetween = 0.001f - 2 * kPrincipal;

class Realistic : public testing::Test {
 protected:
  std::unique_ptr<Camera> camera(std::vector<Param> params, const Matrix4& to_world = {}, float diagonal = 0.01f) {
    put_file(lens_, kBulges);
    params.push_back(text("lensfile", lens_.string()));
    return make(camera_plugins(), "realistic", std::move(params),
                CameraContext{Transform(to_world), 300, 200, diagonal});
  }
  std::string errors(const std::string& lens, std::vector<Param> params) {
    put_file(lens_, lens);
    params.push_back(text("lensfile", lens_.string()));
    return errors_of(camera_plugins(), "realistic", std::move(params), CameraContext{{}, 300, 200});
  }

  TemporaryDirectory directory_;
  std::filesystem::path lens_ = directory_ / "thin.dat";
};

/// From the film to the principal plane, if it is focused so far from the film: 1/a + 1/b = 1/f with a + b known.
float to_film(float distance) {
  const float both = distance - kBetween;
  return (both - std::sqrt(both * (both - 4 * kFocalLength))) / 2;
}

// A perspective camera in the lens' principal plane, whose field of view is that of the film behind it. Near the axis all
// of a wide aperture meets where that looks; further out this holds for a narrow one, for a single lens has aberrations.
TEST_F(Realistic, ThinLensIsAPerspective) {
  const Matrix4 to_world = Matrix4::translate(1, 2, 3) * Matrix4::rotate(40, 1, 3, 2);
  const Vec3 axis = Transform(to_world).vector({0, 0, 1});
  for (const float distance : {1.f, 3.f})
    for (const auto& [diagonal, aperture] : {std::pair{0.001f, 2.f}, {0.01f, 0.2f}}) {
      const float behind = to_film(distance), half_height = diagonal / std::sqrt(13.f);
      const auto seen =
          camera({number("focusdistance", distance), number("aperturediameter", aperture)}, to_world, diagonal);
      const auto thin =
          make(camera_plugins(), "perspective", {number("fov", 360 / kPi * std::atan(half_height / behind))},
               CameraContext{Transform(to_world * Matrix4::translate(0, 0, behind + kBetween)), 300, 200});
      const float before = distance - behind - kBetween, pixel = thin->pixel_spacing(before);
      for (std::uint64_t i = 0; i < 200; ++i) {
        const PathRandom random(1, Stream::setup, i, 0);
        const Vec2 u = random.pair(0, 0), film{u.x * 300, u.y * 200}, lens = random.pair(0, 1);
        if (seen->weight(film, lens) == 0) continue;
        const Ray ray = seen->ray(film, lens), central = thin->ray(film, {});
        EXPECT_NEAR(length(ray.direction), 1, 1e-6f);
        const Vec3 focus = central.at(before / dot(central.direction, axis));
        EXPECT_LT(length(cross(focus - ray.origin, ray.direction)), 0.5f * pixel) << distance << ' ' << diagonal;
      }
      EXPECT_NEAR(seen->pixel_spacing(before) / pixel, 1, 1e-3f);
    }
}

/// The mean of a pixel's weights, by a grid.
double mean_weight(const Camera& camera, Vec2 film, int side = 128) {
  double sum = 0;
  for (int i = 0; i < side * side; ++i)
    sum += static_cast<double>(camera.weight(film, {(static_cast<float>(i % side) + 0.5f) / static_cast<float>(side),
                                                    (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side)}));
  return sum / (side * side);
}

/// The irradiance by a disk of radius r and radiance 1 that faces a place z away and x beside its axis.
/// [Foote 1915; Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-12]
double irradiance_of_disk(double r, double x, double z) {
  const double s = x * x + z * z + r * r;
  return std::numbers::pi / 2 * (1 - (s - 2 * r * r) / std::sqrt(s * s - 4 * r * r * x * x));
}

// A world of radiance 1 makes the irradiance of the pupil: of the stop, as it lies behind the glass.
TEST_F(Realistic, WeightsAreTheIrradianceOfTheFilm) {
  for (const float diameter : {1.f, 12.f}) {
    const auto seen = camera({number("focusdistance", 2), number("aperturediameter", diameter)}, {}, 0.036f);
    const double r = static_cast<double>(diameter) / 2000, z = static_cast<double>(to_film(2) - kPrincipal) - 1e-5;
    for (const Vec2 film : {Vec2{150, 100}, Vec2{30, 100}, Vec2{299, 1}}) {
      const float pixel = 0.036f / std::hypot(300.f, 200.f);
      const double x = static_cast<double>(std::hypot(film.x - 150, film.y - 100) * pixel);
      EXPECT_NEAR(mean_weight(*seen, film) / irradiance_of_disk(r, x, z), 1, 5e-3) << diameter << " at " << film.x;
    }
  }
}

TEST_F(Realistic, ShapesOfTheStopAreAsBright) {
  Image heart(8, 8);
  for (int i = 10; i < 50; i += 3) heart.pixels[static_cast<std::size_t>(i)] = Rgb(1);
  write_png(directory_ / "heart.png", heart);
  const auto with = [&](const std::string& aperture) {
    return mean_weight(*camera({number("aperturediameter", 4), text("aperture", aperture)}), {150, 100});
  };
  const double round = with("");
  for (const std::string& shape : {std::string("gaussian"), std::string("square"), std::string("pentagon"),
                                   std::string("star"), (directory_ / "heart.png").string()})
    EXPECT_NEAR(with(shape) / round, 1, 0.02) << shape;
}

TEST_F(Realistic, SimpleWeightingDoesWithoutTheAperture) {
  for (const float diameter : {2.f, 8.f})
    EXPECT_NEAR(mean_weight(*camera({number("aperturediameter", diameter), flag("simpleweighting", true)}), {150, 100}),
                std::numbers::pi / 4, 0.01);
}

TEST_F(Realistic, SeesWhatStandsUprightUprightAndUnmirrored) {
  const auto seen = camera({number("aperturediameter", 1)});
  EXPECT_GT(seen->ray({150, 10}, {0.5f, 0.5f}).direction.y, 0);
  EXPECT_LT(seen->ray({10, 100}, {0.5f, 0.5f}).direction.x, 0);
  EXPECT_FALSE(seen->sight({0, 0, 3}, {}));
}

TEST_F(Realistic, SaysWhatIsWrong) {
  EXPECT_NE(errors("50 1 1.5", {}).find("it has 3 numbers, but a lens has four"), std::string::npos);
  EXPECT_NE(errors(kBulges, {number("focusdistance", 0.1f)}).find("closer than 0.201 m"), std::string::npos);
  EXPECT_EQ(errors(kBulges, {number("aperturediameter", 30)}),
            "the lens' stop opens to 20 mm only, so that is its diameter\n");
  EXPECT_NE(errors("50 1 1.5 20\n-50 50 1 20", {number("aperturediameter", 3)}).find("the lens has no stop"),
            std::string::npos);
  EXPECT_NE(errors(kBulges, {text("aperture", "hexagon")}).find("there is no file"), std::string::npos);
  EXPECT_NE(errors("-50 1 1.5 20\n50 50 1 20", {}).find("it scatters light"), std::string::npos);
  Diagnostics diagnostics;
  make(camera_plugins(), "realistic", {}, CameraContext{}, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 1);
}

}  // namespace
}  // namespace dspm
