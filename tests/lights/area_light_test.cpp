// illuminate(), pdf_w() and emitted() of area lights say the same of every point of every shape.
#include <gtest/gtest.h>

#include <filesystem>

#include "dspm/image/write_floats.h"
#include "dspm/textures/plain_texture.h"
#include "tests/lights/density.h"
#include "tests/lights/lamps.h"

namespace dspm {
namespace {

using namespace dspm::test;

struct LampHit {
  SurfacePoint point;
  int primitive;
};

/// Everything of the lamp that a ray goes through.
std::vector<LampHit> hits(const AreaLamp& lamp, const Vec3& from, const Vec3& w) {
  std::vector<LampHit> found;
  for (int k = 0; k < lamp.shape->primitive_count(); ++k)
    for (Ray ray{from, w}; const auto hit = lamp.placed->intersect(k, ray);) {
      found.push_back({lamp.placed->surface_point(k, hit->uv), k});
      ray = found.back().point.spawn(w);
    }
  return found;
}

const Vec3 kPoints[] = {{0.3f, -0.2f, -3}, {1.9f, 1.2f, -0.8f}};

// Densities above 40 / sr, at the silhouettes, are left out on both sides: their variance has no bound. 22 comparisons,
// each of which fails for right code in one of 4500 cases.
TEST(AreaLight, SampledDirectionsFollowPdfW) {
  constexpr float kMost = 40;
  for (const AreaLamp& lamp : area_lamps())
    for (const Vec3& from : kPoints) {
      DensityComparison comparison;
      comparison.add_samples(100'000, [&](Sequence& random) {
        const auto l = lamp.light->illuminate(from, random.pair());
        if (l && l->pdf_w < kMost) comparison.sample(l->wi);
      });
      comparison.add_claims(500'000, [&](const Vec3& w) {
        float sum = 0;
        for (const LampHit& hit : hits(lamp, from, w)) {
          const float pdf_w = lamp.light->pdf_w(from, hit.point, hit.primitive);
          if (pdf_w < kMost) sum += pdf_w;
        }
        return sum;
      });
      EXPECT_GT(comparison.p_value(), 0.01 / 45) << lamp.name;
      EXPECT_LT(comparison.deviation(), 4) << lamp.name;
    }
}

TEST(AreaLight, WhatIsSampledIsWhatARayMeets) {
  for (const AreaLamp& lamp : area_lamps())
    for (const Vec3& from : kPoints) {
      Sequence random(8);
      int missed = 0, n = 0;
      for (int i = 0; i < 5000; ++i) {
        const auto l = lamp.light->illuminate(from, random.pair());
        if (!l) continue;
        ++n;
        float nearest = kInfinity, pdf = 0;
        Rgb radiance;
        for (const LampHit& hit : hits(lamp, from, l->wi)) {
          const float off = std::abs(length(hit.point.p - from) - l->distance);
          if (std::abs(dot(hit.point.ng, l->wi)) < 0.02f || off >= nearest) continue;
          nearest = off;
          pdf = lamp.light->pdf_w(from, hit.point, hit.primitive);
          radiance = lamp.light->emitted(hit.point, -l->wi);
        }
        if (nearest > 1e-3f) {
          ++missed;
          continue;
        }
        EXPECT_NEAR(pdf / l->pdf_w, 1, 2e-2f) << lamp.name;
        EXPECT_EQ(radiance, l->radiance) << lamp.name;
      }
      EXPECT_LT(missed, 0.05 * n + 5) << lamp.name;  // those seen edge on
    }
}

/// Irradiance at `from` on a surface with normal n.
float irradiance(const Light& light, const Vec3& from, const Vec3& n, int samples) {
  Sequence random(9);
  double sum = 0;
  for (int i = 0; i < samples; ++i)
    if (const auto l = light.illuminate(from, random.pair()))
      sum += static_cast<double>(l->radiance.g * std::max(0.f, dot(l->wi, n)) / (l->pdf_w > 0 ? l->pdf_w : 1));
  return static_cast<float>(sum / samples);
}

// A disk of radius r seen from its axis at distance d gives pi L r^2 / (r^2 + d^2); a sphere, pi L (r / d)^2.
TEST(AreaLight, IlluminatesAsDisksAndSpheresMust) {
  const Param white = rgb("L", Rgb(2));
  const AreaLamp disk = make_lamp("disk", make_shape("disk", {number("radius", 1.5f)}), {}, {white});
  EXPECT_NEAR(irradiance(*disk.light, {0, 0, 2}, {0, 0, -1}, 400'000), 2 * kPi * 2.25f / 6.25f, 5e-3f);
  EXPECT_EQ(irradiance(*disk.light, {0, 0, -2}, {0, 0, 1}, 1000), 0);
  const Matrix4 twice = Matrix4::scale(2, 2, 2);
  const AreaLamp sphere = make_lamp("sphere", make_shape("sphere", {number("radius", .5f)}), twice, {white});
  EXPECT_NEAR(irradiance(*sphere.light, {0, 3, 0}, {0, -1, 0}, 400'000), 2 * kPi / 9, 5e-3f);
}

TEST(AreaLight, ShinesToTheSideOfItsNormal) {
  SurfacePoint up;
  up.ng = up.ns = {0, 0, 1};
  const auto emitted = [&](std::vector<Param> params, float z) {
    params.push_back(rgb("L", {3, 2, 1}));
    params.push_back(number("scale", 2));
    const AreaLamp lamp = make_lamp("disk", make_shape("disk", {}), {}, std::move(params));
    return lamp.light->emitted(up, normalize({1, 0, z}));
  };
  EXPECT_EQ(emitted({}, 1), Rgb(6, 4, 2));
  EXPECT_EQ(emitted({}, -1), Rgb());
  EXPECT_EQ(emitted({flag("twosided", true)}, -1), Rgb(6, 4, 2));
}

TEST(AreaLight, PowerIsThatOfTheWholeShape) {
  const auto lumen = [](std::unique_ptr<Shape> shape, std::vector<Param> params) {
    params.push_back(number("power", 100));
    return luminance(make_lamp("", std::move(shape), Matrix4::scale(2, 1, 3), std::move(params)).light->power());
  };
  EXPECT_NEAR(lumen(make_shape("sphere", {}), {}), 100, 1e-3f);
  EXPECT_NEAR(lumen(make_shape("disk", {}), {flag("twosided", true)}), 100, 1e-3f);
  EXPECT_NEAR(lumen(unequal_mesh(), {number("scale", 0.5f)}), 50, 1e-3f);
  EXPECT_NEAR(lumen(unequal_mesh(), {rgb("L", Rgb(0.25f))}), 25, 1e-3f);  // as pbrt: L's luminance still counts
}

// The area of a stretched sphere against the formula for spheroids: a prolate one of half axes 1, 1, 2.
TEST(AreaLight, KnowsTheAreaOfWhatIsStretched) {
  const AreaLamp lamp = make_lamp("spheroid", make_shape("sphere", {}), Matrix4::scale(1, 1, 2));
  const float e = std::sqrt(0.75f), area = 2 * kPi * (1 + 2 / e * std::asin(e));
  EXPECT_NEAR(lamp.light->power().g, kPi * area, 2e-3f * kPi * area);
}

/// A unit square in z = 0, seen from above, with texture coordinates from 0 to 1.
std::unique_ptr<Shape> square() {
  MeshData data{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  return std::make_unique<TriangleMesh>(std::move(data));
}
std::unique_ptr<Shape> patch() {
  return make_shape("bilinearmesh",
                    {{ParamType::point3, "P", {}, std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {}, {}}});
}

/// Dark but for a few pixels, and its path.
std::string picture() {
  Image image(32, 16);
  Sequence random(11);
  for (Rgb& c : image.pixels) c = Rgb(random.pair().x < 0.1f ? 20.f : 0.1f) * Rgb(1, 0.5f, 0.25f);
  const auto path = std::filesystem::temp_directory_path() / "dspm_area_light_test.pfm";
  write_pfm(path, image);
  return path.string();
}

/// The irradiance at `from` by a sum over a grid of points of the square.
double irradiance_of_square(const Light& light, const Vec3& from, const Vec3& n, int grid) {
  double sum = 0;
  for (int y = 0; y < grid; ++y)
    for (int x = 0; x < grid; ++x) {
      SurfacePoint point;
      point.p = {(static_cast<float>(x) + 0.5f) / static_cast<float>(grid),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(grid), 0};
      point.uv = {point.p.x, point.p.y};
      point.ng = point.ns = {0, 0, 1};
      const Vec3 d = point.p - from, w = normalize(d);
      sum +=
          static_cast<double>(light.emitted(point, -w).g * std::max(0.f, dot(w, n)) * std::max(0.f, -w.z) / length2(d));
    }
  return sum / (grid * grid);
}

TEST(AreaLight, APictureShinesWhereItIsBright) {
  const std::string file = picture();
  for (const bool bent : {false, true}) {
    const AreaLamp lamp = make_lamp("picture", bent ? patch() : square(), {}, {text("filename", file)});
    const AreaLamp plain = make_lamp("plain", bent ? patch() : square(), {}, {});
    const Vec3 from{0.3f, 0.6f, 0.7f}, n = normalize({0.1f, 0, -1});
    const double expected = irradiance_of_square(*lamp.light, from, n, 1024);
    EXPECT_NEAR(irradiance(*lamp.light, from, n, 200'000), expected, 0.01 * expected);
    // As few samples as would not do if they were uniform: the standard error would be 20%.
    EXPECT_NEAR(irradiance(*lamp.light, from, n, 400), expected, 0.15 * expected);

    Sequence random(12);
    Rgb flux;
    constexpr int kPhotons = 100'000;
    for (int i = 0; i < kPhotons; ++i)
      if (const auto e = lamp.light->emit(random.pair(), random.pair())) flux += e->flux / float{kPhotons};
    EXPECT_NEAR(flux.g / lamp.light->power().g, 1, 0.02);
    EXPECT_NEAR(lamp.light->power().b / lamp.light->power().r, 0.25f, 1e-4f);
  }
}

TEST(AreaLight, APictureKnowsItsDensities) {
  const AreaLamp lamp = make_lamp("picture", square(), {}, {text("filename", picture())});
  Sequence random(13);
  const Vec3 from{0.3f, 0.6f, 0.7f};
  int off = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto l = lamp.light->illuminate(from, random.pair());
    ASSERT_TRUE(l);
    SurfacePoint point;
    point.p = from + l->wi * l->distance, point.ng = point.ns = l->normal;
    off += std::abs(lamp.light->pdf_w(from, point, l->primitive) / l->pdf_w - 1) > 1e-3f;
    const Vec2 place = random.pair(), direction = random.pair();
    const auto e = lamp.light->emit(place, direction);
    const EmissionNumbers u = lamp.light->emission_numbers(e->ray, e->normal, e->primitive);
    off += std::abs(u[0] - place.x) > 1e-3f || std::abs(u[1] - place.y) > 1e-3f;
    off += std::abs(lamp.light->pdf_emit(e->ray, e->normal, e->primitive).position / e->pdf.position - 1) > 1e-3f;
  }
  EXPECT_LT(off, 40);  // at the borders of cells
}

TEST(AreaLight, EitherAColourOrAPicture) {
  Diagnostics diagnostics;
  const AreaLamp lamp = make_lamp("plain", square(), {});
  LightContext context;
  context.shape = lamp.placed.get();
  const std::vector<Param> both{text("filename", picture()), rgb("L", Rgb(1))};
  make(area_light_plugins(), "diffuse", both, context, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 1);
}

// Half of the surface is there, so half of the light is, and more of what is sampled comes from there.
TEST(AreaLight, ShinesWhereItIsThere) {
  class Half final : public Cutout {
    float alpha(const SurfacePoint& point) const override { return point.p.x < 0.5f ? 1.f : 0.f; }
    std::optional<PlainTexture<float>> plain() const override { return std::nullopt; }
  };
  const Half half;
  AreaLamp lamp = make_lamp("half", square(), {});
  const AreaLamp plain = make_lamp("plain", square(), {});
  lamp.placed->cutout = &half;
  LightContext context;
  context.shape = lamp.placed.get();
  const auto light = make(area_light_plugins(), "diffuse", {}, context);
  EXPECT_NEAR(light->power().g, 0.5f * lamp.light->power().g, 1e-4f);
  Sequence random(14);
  int there = 0;
  for (int i = 0; i < 1000; ++i)
    if (const auto l = light->illuminate({0.5f, 0.5f, 1}, random.pair())) there += l->wi.x < 0 ? 1 : -1000;
  EXPECT_GT(there, 800);

  context.hidden = true;  // as if it were a hole everywhere: all shines, and nothing can be hit
  const auto hidden = make(area_light_plugins(), "diffuse", {}, context);
  EXPECT_NEAR(hidden->power().g, lamp.light->power().g, 1e-4f);
  const Vec3 from{0.5f, 0.5f, 1}, down{0, 0, -1};
  EXPECT_EQ(hidden->illuminate(from, {0.5f, 0.5f})->pdf_w, 0);
  EXPECT_NEAR(irradiance(*hidden, from, down, 100'000), irradiance(*plain.light, from, down, 100'000), 0.01f);
}

// Where all is dark, a point is drawn by its area: one of a degenerate triangle would have no normal.
TEST(AreaLight, DegenerateTrianglesAreNoPlaceOfADarkPicture) {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  data.uvs = {{0, 0}, {1, 0}, {0, 1}};
  data.faces = {{0, 1, 1}, {0, 1, 2}, {0, 0, 0}, {1, 1, 2}};
  const std::string dark = (std::filesystem::temp_directory_path() / "dspm_dark.pfm").string();
  write_pfm(dark, Image(2, 2));
  const AreaLamp lamp = make_lamp("dark", std::make_unique<TriangleMesh>(data), {}, {text("filename", dark)});
  Sequence random(15);
  for (int i = 0; i < 100; ++i) {
    const auto start = lamp.light->emit(random.pair(), random.pair());
    EXPECT_TRUE(!start || is_finite(start->ray.direction));
  }
}

// Points of a flat lamp see the others edge-on: rounding puts some of them a little beside the plane.
TEST(AreaLight, SeesItselfWithFiniteDensities) {
  for (const AreaLamp& lamp : area_lamps()) {
    Sequence random(21);
    for (int i = 0; i < 20'000; ++i) {
      const auto start = lamp.light->emit(random.pair(), random.pair());
      if (!start) continue;
      const auto lit = lamp.light->illuminate(start->ray.origin, random.pair());
      EXPECT_TRUE(!lit || (std::isfinite(lit->pdf_w) && is_finite(lit->radiance))) << lamp.name;
    }
  }
}

TEST(AreaLight, DegenerateTrianglesDoNotShine) {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  data.faces = {{0, 1, 2}, {0, 1, 1}};
  MeshData mixed = data;
  mixed.faces.push_back({0, 1, 3});
  for (const Matrix4& to_world : {Matrix4(), Matrix4::scale(1, 2, 3)}) {
    const AreaLamp none = make_lamp("none", std::make_unique<TriangleMesh>(data), to_world, {number("power", 5)});
    EXPECT_TRUE(is_black(none.light->power()));
    EXPECT_FALSE(none.light->emit({0.5f, 0.5f}, {0.5f, 0.5f}));
    EXPECT_FALSE(none.light->illuminate({0, 0, 1}, {0.5f, 0.5f}));
    const AreaLamp one = make_lamp("one", std::make_unique<TriangleMesh>(mixed), to_world);
    Sequence random(10);
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = random.pair();
      EXPECT_GT(one.light->emit(u, random.pair()).value().ray.origin.y, 0);
      EXPECT_TRUE(is_finite(one.light->emit(u, random.pair()).value().flux));
    }
  }
}

}  // namespace
}  // namespace dspm
