// The photons of a light bring to a surface what illuminate() says arrives there, and their mean flux is its power.
#include <gtest/gtest.h>

#include <array>

#include "tests/lights/environment.h"
#include "tests/lights/lamps.h"
#include "tests/lights/named_lights.h"
#include "tests/lights/random.h"

namespace dspm {
namespace {

using namespace dspm::test;

/// Mean of many values, and its standard deviation.
struct Mean {
  double n = 0, sum = 0, sum2 = 0;

  void add(double x) { n += 1, sum += x, sum2 += x * x; }
  double mean() const { return sum / n; }
  double variance() const { return std::max(0., (sum2 / n - mean() * mean()) / n); }
};
using RgbMean = std::array<Mean, 3>;

void add(RgbMean& mean, const Rgb& c) {
  for (int i = 0; i < 3; ++i) mean[static_cast<std::size_t>(i)].add(static_cast<double>(c[i]));
}

// 4.5 standard deviations: one comparison in 150,000 of right code fails; there are about 200, with fixed seeds.
void expect_equal(const RgbMean& a, const RgbMean& b, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double sigma = std::sqrt(a[i].variance() + b[i].variance());
    EXPECT_NEAR(a[i].mean(), b[i].mean(), 4.5 * sigma + 1e-5 * std::abs(a[i].mean())) << what << ", channel " << i;
    EXPECT_LT(sigma, 0.05 * a[i].mean()) << what << ": too few samples to tell";
  }
}

/// A square that receives light on the side of its z.
struct Receiver {
  Vec3 center;
  Basis basis;
  float half;

  float area() const { return 4 * half * half; }
  bool is_hit(const Ray& ray) const {
    const float cosine = -dot(ray.direction, basis.z), t = dot(ray.origin - center, basis.z) / cosine;
    if (!(cosine > 0 && t > 0)) return false;
    const Vec3 local = basis.to_local(ray.at(t) - center);
    return std::abs(local.x) < half && std::abs(local.y) < half;
  }
  Vec3 point(Vec2 u) const { return center + basis.x * (half * (2 * u.x - 1)) + basis.y * (half * (2 * u.y - 1)); }
};

/// Of photons that start as `drawn` draws them, with the light's own weights.
RgbMean flux_by_photons(const Light& light, const Light& drawn, const Receiver& receiver, int n) {
  Sequence random(1);
  RgbMean flux;
  for (int i = 0; i < n; ++i) {
    const Vec2 u_position = random.pair(), u_direction = random.pair();
    const std::optional<Emission> e = drawn.emit(u_position, u_direction);
    EXPECT_NEAR(e ? length(e->ray.direction) : 1, 1, 2e-6f);
    add(flux, e && receiver.is_hit(e->ray) ? e->flux * light.ratio_along(drawn, e->ray) : Rgb());
  }
  return flux;
}

RgbMean flux_by_illumination(const Light& light, const Receiver& receiver, int n) {
  Sequence random(2);
  RgbMean flux;
  for (int i = 0; i < n; ++i) {
    const Vec3 p = receiver.point(random.pair());
    const std::optional<Illumination> l = light.illuminate(p, random.pair());
    const float cosine = l ? std::max(0.f, dot(l->wi, receiver.basis.z)) : 0;
    add(flux, cosine > 0 ? l->radiance * (cosine * receiver.area() / (l->pdf_w > 0 ? l->pdf_w : 1)) : Rgb());
  }
  return flux;
}

RgbMean flux_of_all_photons(const Light& light, int n) {
  Sequence random(3);
  RgbMean flux;
  for (int i = 0; i < n; ++i) {
    const Vec2 u_position = random.pair(), u_direction = random.pair();
    const std::optional<Emission> e = light.emit(u_position, u_direction);
    add(flux, e ? e->flux : Rgb());
  }
  return flux;
}

void expect_photons_agree(const Light& light, const Receiver& receiver, const std::string& name) {
  constexpr int n = 200'000;
  expect_equal(flux_by_photons(light, light, receiver, n), flux_by_illumination(light, receiver, n), name);
  RgbMean power;
  add(power, light.power());
  expect_equal(flux_of_all_photons(light, n), power, name + ", power");
}

const Receiver kBelow{{0.3f, -0.2f, -2}, Basis::around({0, 0, 1}), 2};
const Receiver kSlanted{{1.5f, 0.8f, -1.5f}, Basis::around(normalize({-2, -1, 1})), 1.5f};

TEST(Photons, AgreeWithIlluminationForAreaLights) {
  for (const AreaLamp& lamp : area_lamps()) {
    expect_photons_agree(*lamp.light, kBelow, lamp.name);
    expect_photons_agree(*lamp.light, kSlanted, lamp.name + ", slanted");
  }
}

TEST(Photons, AgreeWithIlluminationForPointLights) {
  LightContext context;
  context.to_world = Transform(Matrix4::translate(0, 0, 1) * Matrix4::scale(2, 2, 2));
  const auto light = make_light("point", {rgb("I", {3, 2, 1}), point("from", {.1f, 0, -.2f})}, context);
  expect_photons_agree(*light, kBelow, "point");
  expect_photons_agree(*light, kSlanted, "point, slanted");
}

TEST(Photons, AgreeWithIlluminationForSpots) {
  const auto spot = [](float angle, float delta) {
    return make_light("spot",
                      {rgb("I", {3, 2, 1}), point("from", {0, 0, 1}), point("to", {.3f, -.2f, -2}),
                       number("coneangle", angle), number("conedeltaangle", delta)},
                      {});
  };
  for (const auto& [angle, delta] : {std::pair{40.f, 5.f}, {40.f, 40.f}, {100.f, 80.f}, {30.f, 0.f}, {180.f, 20.f}}) {
    const std::string name = "spot " + std::to_string(angle) + " " + std::to_string(delta);
    expect_photons_agree(*spot(angle, delta), kBelow, name);
  }
  // So narrow that the receiver must look at the falloff itself.
  const Receiver tiny{{.3f, -.2f, -2}, Basis::around(-normalize({.3f, -.2f, -3})), 3 * std::sin(0.005f)};
  expect_photons_agree(*spot(0.5f, 0.5f), tiny, "narrow spot");
}

TEST(Photons, AgreeWithIlluminationForPointsThatAnImageShapes) {
  LightContext context;
  context.to_world = Transform(Matrix4::translate(0, 0, 1) * Matrix4::rotate(180, 1, .1, 0));
  const EnvironmentFile square(6, 6), panorama(8, 4);
  for (const EnvironmentFile* file : {&square, &panorama})
    for (const std::string kind : {"goniometric", "projection"}) {
      const auto light = make_light(kind, {text("filename", file->path()), number("scale", 3)}, context);
      expect_photons_agree(*light, kBelow, kind + file->path());
    }
}

// A receiver within the inner cone of both, and one that sees the falloffs.
TEST(Photons, OfASpotStartAsThoseOfAWiderOne) {
  const auto spot = [](float angle, float delta, const Rgb& intensity) {
    return make_light("spot",
                      {rgb("I", intensity), point("from", {0, 0, 1}), point("to", {0, 0, -2}),
                       number("coneangle", angle), number("conedeltaangle", delta)},
                      {});
  };
  const auto wide = spot(40, 12, {3, 2, 1}), narrow = spot(34, 10, {1, 4, 2});
  ASSERT_TRUE(narrow->starts_like(*wide));
  for (const float half : {0.4f, 4.f}) {
    const Receiver below{{0.2f, 0.1f, -2}, Basis::around({0, 0, 1}), half};
    expect_equal(flux_by_photons(*narrow, *wide, below, 200'000), flux_by_illumination(*narrow, below, 200'000),
                 "half width " + std::to_string(half));
  }
}

TEST(Photons, OfASunStartAsThoseOfAWiderOne) {
  const auto disk = [](float angle, const Rgb& irradiance) {
    return make_light("distant",
                      {rgb("L", irradiance), point("from", {1, 2, 4}), point("to", {}), number("angle", angle)},
                      around_the_scene());
  };
  const auto wide = disk(50, {3, 2, 1}), narrow = disk(40, {1, 4, 2});
  ASSERT_TRUE(narrow->starts_like(*wide));
  EXPECT_FALSE(wide->starts_like(*narrow));
  EXPECT_FALSE(disk(30, Rgb(1))->starts_like(*wide));  // less than half of it
  const Receiver below{{0.2f, 0.1f, -2}, Basis::around({0, 0, 1}), 1};
  expect_equal(flux_by_photons(*narrow, *wide, below, 200'000), flux_by_illumination(*narrow, below, 200'000), "sun");
}

TEST(Photons, AgreeWithIlluminationForDistantAndInfiniteLights) {
  LightContext context;
  context.scene_center = {.5f, .2f, -1.5f};
  context.scene_radius = 4;
  const auto sun = make_light("distant", {rgb("L", {3, 2, 1}), point("from", {1, 2, 4}), point("to", {})}, context);
  expect_photons_agree(*sun, kBelow, "distant");
  for (const NamedLight& disk : sun_disks()) expect_photons_agree(*disk.light, kBelow, disk.name);
  const auto sky = make_light("infinite", {rgb("L", {3, 2, 1})}, context);
  expect_photons_agree(*sky, kBelow, "infinite");
  context.to_world = Transform(Matrix4::rotate(70, 1, 2, 3) * Matrix4::scale(-1, 1, 1));
  const EnvironmentFile square(6, 6), panorama(8, 4);
  for (const EnvironmentFile* file : {&square, &panorama}) {
    const auto light = make_light("infinite", {text("filename", file->path())}, context);
    expect_photons_agree(*light, kBelow, file->path());
    expect_photons_agree(*light, kSlanted, file->path() + ", slanted");
  }
}

TEST(Photons, AgreeWithIlluminationThroughPortals) {
  LightContext context;
  context.scene_center = {.5f, .2f, -1.5f};
  context.scene_radius = 4;
  const EnvironmentFile file(6, 6);
  const Param portal{
      ParamType::point3, "portal", {}, std::vector<float>{-1, -1, 1, -1, 1, 1, 1, 1, 1, 1, -1, 1}, {}, {}};
  const auto light = make_light("infinite", {text("filename", file.path()), portal}, context);
  expect_photons_agree(*light, kBelow, "portal");
  expect_photons_agree(*light, kSlanted, "portal, slanted");
}

// With these the sphere around the scene is lit as a whole: photons start outside, and miss no part of it.
TEST(Photons, OfDistantAndInfiniteLightsStartOutsideTheScene) {
  LightContext context;
  context.scene_center = {100, -50, 20};
  context.scene_radius = 3;
  for (const std::string name : {"distant", "infinite"}) {
    const auto light = make_light(name, {}, context);
    Sequence random(4);
    for (int i = 0; i < 10'000; ++i) {
      const Vec2 u = random.pair();
      const Emission e = light->emit(u, random.pair()).value();
      const Vec3 from_center = e.ray.origin - context.scene_center;
      EXPECT_GT(length(from_center), context.scene_radius);
      EXPECT_LT(dot(from_center, e.ray.direction), 0);
      EXPECT_LT(length(cross(from_center, e.ray.direction)), context.scene_radius * 1.00001f);
    }
  }
}

// Area lights shine from their surface: to the outside, from a point off it by no more than rounding.
TEST(Photons, OfAreaLightsLeaveTheirSurface) {
  for (const AreaLamp& lamp : area_lamps()) {
    Sequence random(5);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec2 u = random.pair();
      const Emission e = lamp.light->emit(u, random.pair()).value();
      const Ray back{e.ray.origin + 1e-4f * e.ray.direction, -e.ray.direction, 2e-4f};
      const Ray on{e.ray.origin, e.ray.direction, 1e-5f};
      for (int k = 0; k < lamp.shape->primitive_count(); ++k) {
        met += lamp.placed->intersect(k, back).has_value() ? 1 : 0;
        EXPECT_FALSE(lamp.placed->intersect(k, on)) << lamp.name << ": the photon meets its own light";
      }
    }
    EXPECT_GT(met, 1980) << lamp.name;  // all but those at the edges of a shape, which seen aslant are missed
  }
}

}  // namespace
}  // namespace dspm
