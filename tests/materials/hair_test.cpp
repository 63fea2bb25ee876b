// Hair: its passage of light against rays traced through a circle, white fibres that lose nothing, samples against
// densities, photons against camera paths, parameters.
#include <gtest/gtest.h>

#include "dspm/base/math/double_vec.h"
#include "dspm/materials/fibre.h"
#include "dspm/testing/scattering.h"
#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

std::unique_ptr<Material> hair(const Spectrum& sigma_a, float beta_m = 0.3f, float beta_n = 0.3f) {
  return make("hair", {rgb("sigma_a", sigma_a), number("beta_m", beta_m), number("beta_n", beta_n)});
}

struct Roughness {
  float along, around;
};
constexpr Roughness kRoughness[] = {{0.3f, 0.3f}, {0.12f, 0.2f}, {0.9f, 0.6f}, {0.5f, 1}};

/// A fibre along x that faces the direction.
SurfacePoint facing(const Vec3& w, float h) {
  const Vec3 normal = normalize(Vec3{0, w.y, w.z});
  SurfacePoint point{{{}, {}, normal, normal, {1, 0, 0}, {0.3f, 0.5f + 0.5f * h}}};
  point.turns = true;
  return point;
}

/// Mirrored or refracted at the circle's point n, in the plane; d points along the light.
DoubleVec3 mirrored(const DoubleVec3& d, const DoubleVec3& n) { return d - n * (2 * dot(d, n)); }
DoubleVec3 refracted(const DoubleVec3& d, const DoubleVec3& n, double eta) {
  const double c = -dot(d, n), k = 1 - (1 - c * c) / (eta * eta);
  return d * (1 / eta) + n * (c / eta - std::sqrt(k));
}
double azimuth(const DoubleVec3& d) { return std::atan2(d.z, d.y); }
double angle_between(double a, double b) { return std::remainder(a - b, 2 * std::acos(-1.)); }

// Light that runs the way of the ray backwards leaves in the same azimuths. At theta = 0 the cross section is a disk.
TEST(Hair, PathsThroughTheCrossSectionAreThoseOfRays) {
  const float eta = 1.55f, sigma = 0.7f;
  for (const float h : {-0.95f, -0.5f, 0.f, 0.3f, 0.8f}) {
    const FibrePassage passage(0, 1, h, eta, Spectrum(sigma));
    const DoubleVec3 entry{double{h}, 0, std::sqrt(1 - double{h} * h)}, in{0, 0, -1};  // (y, -, z)
    const DoubleVec3 n{0, entry.x, entry.z};
    const double from = azimuth(DoubleVec3{0, 0, 1});
    EXPECT_NEAR(angle_between(azimuth(mirrored(in, n)), from + passage.turn(0)), 0, 1e-5) << h;
    const DoubleVec3 inside = refracted(in, n, eta);
    const double way = -2 * dot(inside, n);
    const DoubleVec3 exit = n + inside * way;
    EXPECT_NEAR(length(exit), 1, 1e-6);
    EXPECT_NEAR(angle_between(azimuth(refracted(inside, exit * -1, 1 / double{eta})), from + passage.turn(1)), 0, 1e-5)
        << h;
    const DoubleVec3 again = mirrored(inside, exit * -1), second = exit + again * way;
    EXPECT_NEAR(angle_between(azimuth(refracted(again, second * -1, 1 / double{eta})), from + passage.turn(2)), 0, 1e-5)
        << h;

    const double f = static_cast<double>(fresnel_dielectric(static_cast<float>(n.z), eta)),
                 t = std::exp(-double{sigma} * way);
    const double expected[] = {f, (1 - f) * (1 - f) * t, (1 - f) * (1 - f) * t * t * f,
                               (1 - f) * (1 - f) * t * t * f * t * f / (1 - t * f)};
    for (std::size_t p = 0; p < 4; ++p) EXPECT_NEAR(passage.attenuation[p][1], expected[p], 1e-5) << h << " " << p;
  }
}

/// The integral of f cos over the sphere by a midpoint rule.
double integral(const Bsdf& bsdf, const Vec3& wo, Transport transport, const Vec3& ns) {
  constexpr int kRows = 160, kColumns = 160;
  double sum = 0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const float z = 2 * (static_cast<float>(row) + 0.5f) / kRows - 1;
      const Vec3 w = direction(z, 2 * kPi * (static_cast<float>(column) + 0.5f) / kColumns), wi{w.z, w.x, w.y};
      sum += static_cast<double>(bsdf.evaluate(wo, wi, transport, 1)[1] * std::abs(dot(wi, ns)));
    }
  return sum * 4 * std::acos(-1.) / (kRows * kColumns);
}

// An index below 1 reflects all light that comes from far along the fibre, whatever it absorbs: nothing is divided by the
// length of a way that is not there.
TEST(Hair, PassagesAreFinite) {
  for (const float eta : {0.51f, 1.f, 1.55f})
    for (const float sin : {-1.f, -0.8f, -0.51f, 0.f, 0.3f, 1.f})
      for (const float h : {-1.f, 0.f, 0.5f, 1.f})
        for (const float sigma : {0.f, 1.f, 1e30f}) {
          const FibrePassage passage(sin, cos_of(sin), h, eta, Spectrum(sigma));
          float sum = 0;
          for (const Spectrum& a : passage.attenuation) {
            EXPECT_TRUE(is_finite(a) && a[0] >= 0) << eta << " " << sin << " " << h << " " << sigma;
            sum += a[0];
          }
          EXPECT_LE(sum, 1 + 1e-5f);
          for (const int p : {0, 1, 2}) EXPECT_TRUE(std::isfinite(passage.turn(p)));
        }
}

TEST(Hair, WhiteFibresLoseNothing) {
  for (const Roughness& r : kRoughness) {
    const auto material = hair(Spectrum(0), r.along, r.around);
    for (const float h : {-0.9f, 0.f, 0.6f})
      for (const Vec3& wo : {Vec3{0, 0, 1}, normalize(Vec3{1, 0.3f, -1}), normalize(Vec3{-2, 1, 0.2f})}) {
        const SurfacePoint point = facing(wo, h);
        BsdfSlot slot;
        const Bsdf& bsdf = material->bsdf(point, slot);
        EXPECT_NEAR(integral(bsdf, wo, Transport::radiance, point.ns), 1, 0.01) << r.along << " " << h << " " << wo.x;
        const PathRandom random(11, Stream::setup, 0, 0);
        EXPECT_NEAR(albedo(bsdf, wo, Transport::radiance, random, 1000).mean[1], 1, 1e-3f);
      }
  }
}

TEST(Hair, SamplesFollowTheirDensity) {
  for (const auto& [along, around] : {kRoughness[0], kRoughness[3]}) {
    const Verdict verdict = samples_follow_density(*hair({0.3f, 0.6f, 1.2f}, along, around), 0.003);
    EXPECT_TRUE(verdict.passed) << along << " " << around << ": " << verdict.message;
  }
}

TEST(Hair, WeightsAndSidesAgree) {
  for (const Roughness& r : kRoughness) {
    const auto material = hair({0.3f, 0.6f, 1.2f}, r.along, r.around);
    for (const auto& check : {weights_agree, keeps_to_sides}) {
      const Verdict verdict = check(*material);
      EXPECT_TRUE(verdict.passed) << r.along << " " << r.around << ": " << verdict.message;
    }
  }
}

// On a surface that does not turn, f for flux is f for radiance the other way round.
TEST(Hair, IsReciprocalOnSurfaces) {
  const auto material = hair({0.3f, 0.6f, 1.2f});
  const PathRandom random(5, Stream::setup, 6, 0);
  for (const SurfacePoint& point : {surface(), bent_surface()}) {
    BsdfSlot slot;
    const Bsdf& bsdf = material->bsdf(point, slot);
    for (int n = 0; n < 500; ++n) {
      const Vec3 wo = any_direction(random, n), wi = any_direction(random, 10'000 + n);
      const Spectrum flux = bsdf.evaluate(wo, wi, Transport::flux, 1),
                     radiance = bsdf.evaluate(wi, wo, Transport::radiance, 1);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c], radiance[c], 1e-3f * radiance[c] + 1e-6f);
    }
  }
}

// A unit of length of the fibre takes cos(theta_i) of the light from wi, and shows cos(theta_o) of its width to wo, each
// from the side that it turns there.
TEST(Hair, PhotonsAreScatteredAsCameraPathsAreBackwards) {
  const auto material = hair({0.3f, 0.6f, 1.2f}, 0.5f, 0.5f);
  const PathRandom random(5, Stream::setup, 7, 0);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 camera = any_direction(random, n), light = any_direction(random, 10'000 + n);
    const SurfacePoint seen = facing(camera, 0.4f), lit = facing(light, 0.4f);
    if (std::abs(dot(light, seen.ns)) < 1e-3f || std::abs(dot(camera, lit.ns)) < 1e-3f) continue;
    BsdfSlot slots[2];
    const Spectrum radiance =
        material->bsdf(seen, slots[0]).evaluate(camera, light, Transport::radiance, 1) * std::abs(dot(light, seen.ns));
    const Spectrum flux =
        material->bsdf(lit, slots[1]).evaluate(light, camera, Transport::flux, 1) * std::abs(dot(camera, lit.ns));
    const float shown = std::hypot(camera.y, camera.z), taken = std::hypot(light.y, light.z);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c] * taken, radiance[c] * shown, 2e-3f * radiance[c] * shown + 1e-6f);
  }
}

TEST(Hair, IsFollowedRatherThanGatheredOn) {
  BsdfSlot slot;
  const auto material = make("hair", {});
  const Bsdf& bsdf = material->bsdf(surface(), slot);
  EXPECT_EQ(int{bsdf.all_lobes()}, 1);
  EXPECT_EQ(int{bsdf.lobes(1e-4f)}, 1);
  EXPECT_EQ(int{bsdf.lobes(1)}, 0);
  EXPECT_TRUE(bsdf.transmits(1));
}

Spectrum seen(const Material& material) {
  BsdfSlot slot;
  return material.bsdf(surface(), slot).evaluate(direction(0.6f, 2), direction(-0.5f, 1), Transport::radiance, 1);
}

TEST(Hair, ColoursMeanAbsorption) {
  const Spectrum brown = seen(*make("hair", {}));
  EXPECT_EQ(brown, seen(*make("hair", {number("eumelanin", 1.3f)})));
  EXPECT_EQ(brown, seen(*hair(Spectrum(0.419f, 0.697f, 1.37f) * 1.3f)));
  EXPECT_EQ(seen(*make("hair", {number("pheomelanin", 2)})), seen(*hair(Spectrum(0.187f, 0.4f, 1.05f) * 2)));
  // [Chiang et al. 2016, 4.2] for beta_n = 0.3: (ln 0.5 / 5.888)^2
  const Spectrum grey = seen(*make("hair", {rgb("color", Rgb(0.5f))})), same = seen(*hair(Spectrum(0.013857f)));
  EXPECT_NEAR(grey[1], same[1], 1e-4f * same[1]);
  EXPECT_EQ(grey, seen(*make("hair", {rgb("reflectance", Rgb(0.5f))})));
}

TEST(Hair, OneColourIsEnough) {
  const auto said = [](std::vector<Param> params) {
    Diagnostics diagnostics;
    make("hair", std::move(params), diagnostics);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  EXPECT_EQ(said({number("eumelanin", 1), number("pheomelanin", 1)}), "");
  EXPECT_EQ(said({rgb("sigma_a", Rgb(1)), rgb("reflectance", Rgb(1))}),
            "\"reflectance\" has no effect beside \"sigma_a\"");
  EXPECT_EQ(said({rgb("reflectance", Rgb(1)), number("eumelanin", 1)}),
            "\"eumelanin\" has no effect beside \"reflectance\"");
}

}  // namespace
}  // namespace dspm::test
