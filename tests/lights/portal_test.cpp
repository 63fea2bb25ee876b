// Light through a portal against the same sky, where the rays pass the portal, and nothing elsewhere.
#include <gtest/gtest.h>

#include "dspm/lights/rectangle.h"
#include "dspm/lights/solid_angle.h"
#include "tests/lights/density.h"
#include "tests/lights/named_lights.h"

namespace dspm {
namespace {

using namespace dspm::test;

// x along (1, 0, 0), y along (0, 1, 0): the light comes from +z.
const std::vector<Vec3> kPortal{{-1, -.5f, 1}, {-1, 1, 1}, {2, 1, 1}, {2, -.5f, 1}};

Param portal_of(const std::vector<Vec3>& points) {
  std::vector<float> values;
  for (const Vec3& p : points) values.insert(values.end(), {p.x, p.y, p.z});
  return {ParamType::point3, "portal", {}, values, {}, {}};
}

std::unique_ptr<Light> sky(std::vector<Param> params, bool portal) {
  LightContext context = around_the_scene();
  context.to_world = Transform(Matrix4::rotate(40, 1, 2, 3));
  if (portal) params.push_back(portal_of(kPortal));
  return make_light("infinite", std::move(params), context);
}

bool passes(const Ray& ray) {
  if (!(ray.direction.z > 0 && ray.origin.z < 1)) return false;
  const Vec3 p = ray.at((1 - ray.origin.z) / ray.direction.z);
  return p.x > -1 && p.x < 2 && p.y > -.5f && p.y < 1;
}

TEST(Portal, ShowsTheSkyOfRaysThatPassIt) {
  const auto open = sky({rgb("L", {3, 2, 1})}, false), portal = sky({rgb("L", {3, 2, 1})}, true);
  Sequence random(1);
  int seen = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = Vec3{3 * random.number() - 1, 2 * random.number() - .5f, 3 * random.number() - 1};
    const Ray ray{p, uniform_sphere(random.pair())};
    const Rgb through = portal->escaped(ray);
    EXPECT_LT(max_component(through - (passes(ray) ? open->escaped(ray) : Rgb())), 1e-4f);
    EXPECT_LT(max_component((passes(ray) ? open->escaped(ray) : Rgb()) - through), 1e-4f);
    EXPECT_EQ(portal->escaped_pdf_w(ray) > 0, passes(ray));
    seen += passes(ray);
  }
  EXPECT_GT(seen, 500);
}

// A white sky of radiance 1: pi times the form factor of the portal, in a plane that is parallel to it.
TEST(Portal, IrradianceIsTheFormFactor) {
  const auto portal = sky({}, true);
  for (const Vec3 p : {Vec3{0, 0, 0}, {1.5f, .7f, .6f}, {-3, 2, -1}}) {
    const double h = 1 - static_cast<double>(p.z);
    const auto at = [&](float edge, float from) { return static_cast<double>(edge - from) / h; };
    const double expected =
        between_corners(at(-1, p.x), at(-.5f, p.y), at(2, p.x), at(1, p.y), projected_solid_angle_to);
    double sum = 0;
    Sequence random(2);
    constexpr int kSamples = 20'000;
    for (int i = 0; i < kSamples; ++i)
      if (const auto l = portal->illuminate(p, random.pair()))
        sum += static_cast<double>(l->radiance.g * l->wi.z / l->pdf_w) / kSamples;
    EXPECT_NEAR(sum / expected, 1, 0.01);
  }
  EXPECT_FALSE(portal->illuminate({0, 0, 1.5f}, {.5f, .5f}));  // from outside
  EXPECT_NEAR(static_cast<double>(portal->power().g), M_PI * 3 * 1.5, 1e-3);
}

TEST(Portal, SamplesFollowTheirDensity) {
  const EnvironmentFile file(9, 9);
  const auto portal = sky({text("filename", file.path())}, true);
  for (const Vec3 p : {Vec3{0, 0, 0}, {1.5f, .7f, .6f}}) {
    DensityComparison comparison;
    comparison.add_samples(100'000, [&](Sequence& random) {
      const auto l = portal->illuminate(p, random.pair());
      if (l) comparison.sample(l->wi);
    });
    comparison.add_claims(500'000, [&](const Vec3& w) { return portal->escaped_pdf_w({p, w}); });
    EXPECT_GT(comparison.p_value(), 0.001);
    EXPECT_LT(comparison.deviation(), 4);
  }
}

TEST(Portal, PhotonsPassItAndKnowTheirDensities) {
  const EnvironmentFile file(9, 9);
  const auto portal = sky({text("filename", file.path())}, true);
  Sequence random(3);
  int other = 0, n = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec2 u_position = random.pair(), u_direction = random.pair();
    const auto e = portal->emit(u_position, u_direction);
    if (!e) continue;
    ++n;
    const Ray there = {e->ray.at(e->must_reach), -e->ray.direction};
    EXPECT_NEAR(there.origin.z, 1, 1e-3f);
    EXPECT_GT(dot(e->ray.origin - around_the_scene().scene_center, -e->ray.direction), kRadius);
    const EmissionPdf pdf = portal->pdf_emit(e->ray, {}, -1);
    const Rgb seen = portal->escaped({e->ray.at(e->must_reach + 1), -e->ray.direction});
    const Rgb product = e->flux * (pdf.position * pdf.direction);
    const EmissionNumbers u = portal->emission_numbers(e->ray, {}, -1);
    other += std::abs(product.g - seen.g) > 1e-3f * (1 + seen.g) || std::abs(u[0] - u_position.x) > 1e-3f ||
             std::abs(u[1] - u_position.y) > 1e-3f || std::abs(u[2] - u_direction.x) > 1e-3f ||
             std::abs(u[3] - u_direction.y) > 1e-3f;
  }
  EXPECT_GT(n, 4900);
  EXPECT_LE(other, 50);  // at borders of cells
}

TEST(Portal, MustBeARectangle) {
  const auto errors = [](std::vector<Vec3> points) {
    return errors_of(light_plugins(), "infinite", {portal_of(std::move(points))}, LightContext{});
  };
  EXPECT_EQ(errors(kPortal), "");
  EXPECT_NE(errors({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}), "");
  EXPECT_NE(errors({{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {1, 0, 0}}), "");
  EXPECT_NE(errors({{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {1, 1, 0}}), "");
  EXPECT_NE(errors({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), "");
}

}  // namespace
}  // namespace dspm
