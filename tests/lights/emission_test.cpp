// The densities that come with photons and with samples of direct light, which bidirectional methods weigh paths by.
#include <gtest/gtest.h>

#include "tests/lights/density.h"
#include "tests/lights/lamps.h"
#include "tests/lights/named_lights.h"

namespace dspm {
namespace {

using namespace dspm::test;

const Vec3 kSeenFrom[] = {{0.3f, -0.2f, -3}, {1.9f, 1.2f, -0.8f}};  // each lamp is seen from one of them

template <class Check>
void for_each_emission(const Light& light, const Check& check) {
  Sequence random(11);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u_position = random.pair();
    if (const auto e = light.emit(u_position, random.pair())) check(*e);
  }
}

/// flux times both densities is `expected`.
void expect_product(const Emission& e, const Rgb& expected, const std::string& name) {
  const Rgb product = e.flux * (e.pdf.position * e.pdf.direction);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(product[c], expected[c], 2e-5f * (1 + expected[c])) << name;
}

void expect_deltas(const EmissionPdf& pdf, bool position, bool direction, const std::string& name) {
  EXPECT_EQ(pdf.delta_position, position) << name;
  EXPECT_EQ(pdf.delta_direction, direction) << name;
}

/// pdf_emit() says of emit()'s results what they say themselves; `exceptions` of 1000 may differ, because rounding
/// takes a direction to the next pixel.
void expect_same_pdf(const Light& light, int exceptions, const std::string& name) {
  int n = 0, different = 0;
  for_each_emission(light, [&](const Emission& e) {
    const EmissionPdf pdf = light.pdf_emit(e.ray, e.normal, e.primitive);
    ++n;
    EXPECT_NEAR(pdf.position / e.pdf.position, 1, 1e-4f) << name;
    different += std::abs(pdf.direction - e.pdf.direction) > 1e-4f * e.pdf.direction ? 1 : 0;
    expect_deltas(pdf, e.pdf.delta_position, e.pdf.delta_direction, name);
  });
  EXPECT_GT(n, 1000) << name;
  EXPECT_LE(different * 1000, exceptions * n) << name;
}

TEST(Emission, OfAnAreaLightIsRadianceTimesCosine) {
  for (const AreaLamp& lamp : area_lamps()) {
    for_each_emission(*lamp.light, [&](const Emission& e) {
      expect_product(e, kStrength * std::abs(dot(e.normal, e.ray.direction)), lamp.name);
      expect_deltas(e.pdf, false, false, lamp.name);
    });
    expect_same_pdf(*lamp.light, 0, lamp.name);
  }
}

// illuminate() at a distance of 1 is the radiant intensity.
TEST(Emission, OfAPointIsRadiantIntensity) {
  for (const NamedLight& named : points()) {
    for_each_emission(*named.light, [&](const Emission& e) {
      const auto l = named.light->illuminate(e.ray.at(1), {});
      EXPECT_EQ(e.pdf.position, 1) << named.name;
      expect_product(e, l ? l->radiance : Rgb(), named.name);
      expect_deltas(e.pdf, true, false, named.name);
    });
    expect_same_pdf(*named.light, 0, named.name);
  }
}

TEST(Emission, OfAPointThatAnImageShapesIsRadiantIntensity) {
  const EnvironmentFile file(7, 7);
  for (const NamedLight& named : shaped(file)) {
    int n = 0, at_a_border = 0;
    for_each_emission(*named.light, [&](const Emission& e) {
      const auto l = named.light->illuminate(e.ray.at(1), {});
      const Rgb seen = l ? l->radiance : Rgb(), product = e.flux * e.pdf.direction;
      const float off = std::max(max_component(product - seen), max_component(seen - product));
      ++n, at_a_border += off > 1e-4f * max_component(seen) ? 1 : 0;
      expect_deltas(e.pdf, true, false, named.name);
    });
    EXPECT_GT(n, 1900) << named.name;
    EXPECT_LE(at_a_border, 2) << named.name;
    expect_same_pdf(*named.light, 1, named.name);
  }
}

TEST(Emission, FromInfinitelyFarAwayIsAcrossTheDisk) {
  const float on_disk = 1 / (kPi * kRadius * kRadius);
  const NamedLight distant = sun();
  for_each_emission(*distant.light, [&](const Emission& e) {
    EXPECT_NEAR(e.pdf.position / on_disk, 1, 1e-6f);
    EXPECT_EQ(e.pdf.direction, 1);
    expect_product(e, kStrength, distant.name);
    expect_deltas(e.pdf, false, true, distant.name);
  });
  expect_same_pdf(*distant.light, 0, distant.name);
  const EnvironmentFile file(7, 7);
  for (const NamedLight& sky : skies(file)) {
    int n = 0, at_a_border = 0;
    for_each_emission(*sky.light, [&](const Emission& e) {
      EXPECT_NEAR(e.pdf.position / on_disk, 1, 1e-6f) << sky.name;
      expect_deltas(e.pdf, false, false, sky.name);
      const Rgb seen = sky.light->escaped({{}, -e.ray.direction});
      const Rgb product = e.flux * (e.pdf.position * e.pdf.direction);
      const float off = std::max(max_component(product - seen), max_component(seen - product));
      ++n, at_a_border += off > 1e-4f * max_component(seen) ? 1 : 0;
    });
    EXPECT_GT(n, 1900) << sky.name;
    EXPECT_LE(at_a_border, 2) << sky.name;
    expect_same_pdf(*sky.light, 1, sky.name);
  }
}

TEST(Emission, LightsWithoutASurfaceHaveNeitherNormalNorPrimitive) {
  const EnvironmentFile file(4, 4);
  std::vector<NamedLight> lights = points();
  lights.push_back(sun());
  for (NamedLight& named : shaped(file)) lights.push_back(std::move(named));
  for (NamedLight& sky : skies(file)) lights.push_back(std::move(sky));
  for (const NamedLight& named : lights) {
    const Emission e = named.light->emit({.3f, .6f}, {.2f, .7f}).value();
    const Illumination l = named.light->illuminate(e.ray.at(1), {.2f, .7f}).value();
    EXPECT_EQ(e.normal, Vec3{}) << named.name;
    EXPECT_EQ(l.normal, Vec3{}) << named.name;
    EXPECT_EQ(e.primitive, -1) << named.name;
    EXPECT_EQ(l.primitive, -1) << named.name;
  }
}

TEST(Emission, OfAnAreaLightStartsOnItsPrimitiveWithItsNormal) {
  for (const AreaLamp& lamp : area_lamps()) {
    int n = 0, met = 0;
    for_each_emission(*lamp.light, [&](const Emission& e) {
      const Ray back{e.ray.origin + 1e-4f * e.ray.direction, -e.ray.direction, 2e-4f};
      ++n;
      if (const auto hit = lamp.placed->intersect(e.primitive, back)) {
        ++met;
        EXPECT_GT(dot(lamp.placed->surface_point(e.primitive, hit->uv).ng, e.normal), 0.999f) << lamp.name;
      }
    });
    EXPECT_GT(met, 0.98 * n) << lamp.name;  // all but those at the edges of a shape, which seen aslant are missed
  }
}

TEST(Emission, DirectLightNamesThePointThatItSampled) {
  for (const AreaLamp& lamp : area_lamps()) {
    Sequence random(12);
    int n = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3& from = kSeenFrom[i % 2];
      const auto l = lamp.light->illuminate(from, random.pair());
      if (!l || std::abs(dot(l->normal, l->wi)) < 0.02f) continue;
      SurfacePoint point;
      point.p = from + l->wi * l->distance;
      point.ng = point.ns = l->normal;
      EXPECT_NEAR(lamp.light->pdf_w(from, point, l->primitive) / l->pdf_w, 1, 1e-3f) << lamp.name;
      const EmissionPdf pdf = lamp.light->pdf_emit({point.p, -l->wi}, l->normal, l->primitive);
      const EmissionNumbers u = lamp.light->emission_numbers({point.p, -l->wi}, l->normal, l->primitive);
      ++n;
      if (u[0] == kAnyNumber) continue;
      const auto same =
          lamp.light->emit({std::min(u[0], 0x1.fffffep-1f), std::min(u[1], 0x1.fffffep-1f)}, {u[2], u[3]});
      ASSERT_TRUE(same) << lamp.name;
      if (same->primitive != l->primitive) continue;  // at an edge
      EXPECT_LT(length(same->ray.origin - point.p), 3e-3f) << lamp.name;
      EXPECT_NEAR(pdf.position / same->pdf.position, 1, 1e-2f) << lamp.name;
    }
    EXPECT_GT(n, 20) << lamp.name;
  }
}

/// The light's emission numbers of what it emits lead to the same start again; `exceptions` of 1000 may differ, because
/// rounding takes a direction to the next pixel.
void expect_numbers(const Light& light, int exceptions, const std::string& name) {
  int n = 0, different = 0;
  for_each_emission(light, [&](const Emission& e) {
    EmissionNumbers u = light.emission_numbers(e.ray, e.normal, e.primitive);
    for (float& number : u) {
      EXPECT_TRUE(number == kAnyNumber || (number >= 0 && number <= 1)) << name << " " << number;
      number = number == kAnyNumber ? 0.37f : std::min(number, 0x1.fffffep-1f);
    }
    const auto again = light.emit({u[0], u[1]}, {u[2], u[3]});
    ++n;
    different += !again || length(again->ray.origin - e.ray.origin) > 1e-3f ||
                         length(again->ray.direction - e.ray.direction) > 2e-3f
                     ? 1
                     : 0;
  });
  EXPECT_GT(n, 1000) << name;
  EXPECT_LE(different * 1000, exceptions * n) << name << ": " << different << " of " << n;
}

TEST(EmissionNumbers, LeadToTheSameStart) {
  for (const AreaLamp& lamp : area_lamps()) expect_numbers(*lamp.light, 2, lamp.name);
  for (const NamedLight& named : points()) expect_numbers(*named.light, 1, named.name);
  expect_numbers(*sun().light, 0, "distant");
  const EnvironmentFile file(7, 7), wide(12, 6);
  for (const EnvironmentFile* map : {&file, &wide})
    for (const NamedLight& sky : skies(*map)) expect_numbers(*sky.light, 4, sky.name);
  for (const EnvironmentFile* map : {&file, &wide})
    for (const NamedLight& named : shaped(*map)) expect_numbers(*named.light, 4, named.name);
}

// If a light did not say which numbers do not matter, the guide's density over them would count as that of the start.
TEST(EmissionNumbers, AreAnyIfTheyDoNotMatter) {
  const EnvironmentFile file(4, 4);
  std::vector<NamedLight> lights = points();
  for (NamedLight& named : shaped(file)) lights.push_back(std::move(named));
  for (const NamedLight& named : lights) {
    const Emission e = named.light->emit({.3f, .6f}, {.2f, .7f}).value();
    const EmissionNumbers u = named.light->emission_numbers(e.ray, e.normal, e.primitive);
    EXPECT_TRUE(u[0] == kAnyNumber && u[1] == kAnyNumber && u[2] >= 0 && u[3] >= 0) << named.name;
  }
  const NamedLight distant = sun();
  const Emission e = distant.light->emit({.3f, .6f}, {.2f, .7f}).value();
  const EmissionNumbers u = distant.light->emission_numbers(e.ray, e.normal, e.primitive);
  EXPECT_TRUE(u[0] >= 0 && u[1] >= 0 && u[2] == kAnyNumber && u[3] == kAnyNumber);
}

// The primitives are summed one by one, so this holds up to rounding.
TEST(Emission, PositionDensitiesIntegrateTo1) {
  constexpr int kSamples = 500;
  for (const AreaLamp& lamp : area_lamps()) {
    Sequence random(13);
    double integral = 0;
    for (int k = 0; k < lamp.shape->primitive_count(); ++k)
      for (int i = 0; i < kSamples; ++i) {
        const AreaSample s = lamp.placed->sample_area(k, random.pair());
        const float pdf_a = lamp.light->pdf_emit({s.point.p, s.point.ng}, s.point.ng, k).position;
        integral += static_cast<double>(pdf_a / s.pdf_a) / kSamples;
      }
    EXPECT_NEAR(integral, 1, 1e-4) << lamp.name;
  }
}

/// A light's photons follow the density by direction that it claims; all start with the same normal.
void expect_directions(const Light& light, const Vec3& normal, const std::string& name) {
  DensityComparison comparison;
  comparison.add_samples(100'000, [&](Sequence& random) {
    const Vec2 u_position = random.pair();
    comparison.sample(light.emit(u_position, random.pair()).value().ray.direction);
  });
  comparison.add_claims(500'000, [&](const Vec3& w) { return light.pdf_emit({{}, w}, normal, 0).direction; });
  EXPECT_GT(comparison.p_value(), 0.001) << name;
  EXPECT_LT(comparison.deviation(), 4) << name;
}

// Fourteen comparisons, each of which fails for right code in one of 1000 cases. Those of a point and of a sky of one
// colour are uniform, and above; no claims would fall into the narrowest sun.
TEST(Emission, DirectionsFollowTheirDensity) {
  const EnvironmentFile file(7, 7);
  for (const NamedLight& named : spots()) expect_directions(*named.light, {}, named.name);
  for (const NamedLight& sky : images(file)) expect_directions(*sky.light, {}, sky.name);
  const std::vector<NamedLight> disks = sun_disks();
  for (std::size_t i = 1; i < disks.size(); ++i) expect_directions(*disks[i].light, {}, disks[i].name);
  for (const NamedLight& named : shaped(file)) expect_directions(*named.light, {}, named.name);
  for (const bool two_sided : {false, true}) {
    const AreaLamp disk =
        make_lamp("disk", make_shape("disk", {}), Matrix4::rotate(30, 1, 1, 0), {flag("twosided", two_sided)});
    const Vec3 normal = disk.light->emit({.5f, .5f}, {.5f, .5f}).value().normal;
    expect_directions(*disk.light, normal, two_sided ? "disk, both sides" : "disk");
  }
}

}  // namespace
}  // namespace dspm
