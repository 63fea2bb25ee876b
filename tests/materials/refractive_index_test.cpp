// Indices of refraction by wavelength: those of catalogues, prisms, rainbows, and what is refused.
#include "dspm/materials/refractive_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dspm/materials/fresnel.h"
#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

constexpr std::int16_t kBlue = 486, kYellow = 588, kRed = 656;
constexpr double kDegree = 3.14159265358979323846 / 180;

double index(const Material& glass, std::int16_t nm) { return double{glass.eta_at({.nm = nm})}; }

std::string errors_of(const std::string& type, std::vector<Param> params) {
  Diagnostics diagnostics;
  try {
    make(type, std::move(params), diagnostics);
  } catch (const SceneError&) {}
  std::string all;
  for (const Diagnostic& each : diagnostics.all()) all += to_string(each);
  return all;
}

// n_d and the Abbe number, as in Schott's catalogue and the papers.
TEST(RefractiveIndex, OfGlassesIsThatOfTheirCatalogues) {
  struct Known {
    const char* glass;
    double yellow, abbe;
  };
  for (const Known& known : {Known{"BK7", 1.5168, 64.17},
                             {"F2", 1.62004, 36.37},
                             {"SF11", 1.78472, 25.76},
                             {"N-SF11", 1.78472, 25.68},
                             {"silica", 1.45846, 67.8},
                             {"sapphire", 1.7682, 72.2},
                             {"diamond", 2.4175, 55.3},
                             {"zirconia", 2.1588, 33.5},
                             {"water", 1.3334, 55.7}})
    for (const char* type : {"dielectric", "principled"}) {
      std::vector<Param> params{text("glass", known.glass)};
      if (type == std::string("principled")) params.push_back(number("transmission", 1));
      const auto material = make(type, params);
      const double yellow = index(*material, kYellow), part = index(*material, kBlue) - index(*material, kRed);
      EXPECT_NEAR(yellow, known.yellow, 2e-4) << known.glass;
      EXPECT_NEAR((yellow - 1) / part, known.abbe, 0.02 * known.abbe) << known.glass;  // of whole nanometres
      EXPECT_TRUE(material->disperses());
    }
}

TEST(RefractiveIndex, OfAnAbbeNumberHasIt) {
  for (const float eta : {1.33f, 1.5f, 1.9f, 2.4f})
    for (const float abbe : {15.f, 30.f, 60.f}) {
      const RefractiveIndex glass = RefractiveIndex::of_abbe(eta, abbe);
      const auto at = [&](std::int16_t nm) { return double{glass.at({.nm = nm})}; };
      EXPECT_EQ(glass.mean(), eta);
      EXPECT_NEAR(at(kYellow), double{eta}, 5e-4);
      EXPECT_NEAR((double{eta} - 1) / (at(kBlue) - at(kRed)), double{abbe}, 0.01 * double{abbe});
    }
  EXPECT_FALSE(RefractiveIndex::of_abbe(1, 20).disperses());
}

TEST(RefractiveIndex, IsReadFromSpectra) {
  const Param pairs{ParamType::spectrum, "eta", {}, std::vector<float>{400, 1.6f, 700, 1.5f}, {}, {}};
  const auto glass = make("dielectric", {pairs});
  EXPECT_NEAR(index(*glass, 550), 1.55, 1e-4);
  EXPECT_NEAR(index(*glass, 380), 1.6, 1e-6) << "constant beyond the samples";
  EXPECT_NEAR(index(*glass, 800), 1.5, 1e-6);
  EXPECT_TRUE(glass->disperses());
  const Param same{ParamType::spectrum, "eta", {}, std::vector<float>{400, 1.5f, 700, 1.5f}, {}, {}};
  EXPECT_FALSE(make("dielectric", {same})->disperses());
  EXPECT_FALSE(make("dielectric", {number("eta", 1.7f)})->disperses());
  Diagnostics notes;
  EXPECT_FALSE(make("principled", {text("glass", "SF11")}, notes)->disperses()) << "it is opaque";
}

TEST(RefractiveIndex, RefusesWhatContradictsItself) {
  const auto expect = [](std::vector<Param> params, const std::string& part) {
    const std::string said = errors_of("dielectric", std::move(params));
    EXPECT_TRUE(contains(said, part)) << said;
  };
  for (const char* name : {"SF12", "F5"}) expect({text("glass", name)}, "unknown glass");
  expect({text("glass", "SF11"), number("eta", 1.5f)}, "leave out \"eta\" and \"abbe\"");
  expect({number("abbe", -3)}, "at least 1");
  expect({number("abbe", 20), Param{ParamType::spectrum, "eta", {}, std::vector<std::string>{"glass-BK7"}, {}, {}}},
         "dispersion of its own");
  expect({number("eta", 0)}, "must be above 0");
}

// A number that is keyed from 0 to 20 passes them between its keys, in renders with a shutter only.
TEST(RefractiveIndex, OfAnAbbeNumberBelow1IsThatOf1) {
  Diagnostics notes;
  const auto low = make("dielectric", {number("abbe", 0.2f)}, notes), one = make("dielectric", {number("abbe", 1)});
  EXPECT_EQ(notes.error_count(), 0);
  EXPECT_EQ(notes.all().size(), 1u);
  EXPECT_EQ(index(*low, 450), index(*one, 450));
  EXPECT_TRUE(low->disperses());
}

/// What the glass refracts (or mirrors) of light of that wavelength that arrives from wo at a surface with normal z.
Vec3 leaves(const Material& glass, const Vec3& wo, std::int16_t nm, bool mirrored = false) {
  SurfacePoint point = surface();
  point.wavelength.nm = nm;
  BsdfSlot slot;
  const Bsdf& bsdf = glass.bsdf(point, slot);
  const auto sample = bsdf.sample(wo, {0.5f, 0.5f, mirrored ? 0.f : 0.99999f}, Transport::flux, bsdf.all_lobes());
  EXPECT_TRUE(sample.has_value());
  EXPECT_EQ(sample->by_wavelength, !mirrored || wo.z < 0);
  return sample->wi;
}
/// Of a direction in the plane of x and z, its angle to z, or to -z if it points down.
double angle(const Vec3& w) { return std::atan2(double{w.x}, std::abs(double{w.z})); }
Vec3 from_above(double radians) {
  return {static_cast<float>(std::sin(radians)), 0, static_cast<float>(std::cos(radians))};
}
Vec3 from_below(double radians) {
  return {static_cast<float>(std::sin(radians)), 0, -static_cast<float>(std::cos(radians))};
}

TEST(Refraction, IsByTheIndicesOnBothSides) {
  const RefractiveIndex flint = RefractiveIndex::of_abbe(1.7f, 25), plain(1.4f);
  SurfacePoint point = surface();
  point.wavelength.nm = 430;
  const float here = flint.at(point.wavelength);
  EXPECT_EQ(Refraction(flint, point).eta, here);
  EXPECT_EQ(Refraction(flint, point).mean_eta, 1.7f);
  EXPECT_FALSE(Refraction(plain, point).disperses());
  point.outside_eta = 1.7f, point.outside_dispersion = here / 1.7f;
  EXPECT_NEAR(Refraction(flint, point).eta, 1, 1e-6f);
  EXPECT_NEAR(Refraction(plain, point).eta, 1.4f / here, 1e-6f);
  EXPECT_TRUE(Refraction(plain, point).disperses()) << "what is around it does";
  point.wavelength.nm = 0;
  EXPECT_EQ(Refraction(flint, point).eta, 1);
}

// A prism deviates light by the least angle if it passes symmetrically: n = sin((A + d) / 2) / sin(A / 2).
TEST(RefractiveIndex, OfAPrismIsThatOfItsLeastDeviation) {
  const double apex = 60 * kDegree;
  const auto glass = make("dielectric", {text("glass", "BK7")});
  for (const std::int16_t nm : {std::int16_t{450}, std::int16_t{550}, std::int16_t{650}}) {
    double least = 10;
    for (int step = 0; step < 4000; ++step) {
      const double in = (40 + step * 0.005) * kDegree;
      const double inside = -angle(leaves(*glass, from_above(in), nm));
      const double second = apex - inside;
      const double out = -angle(leaves(*glass, from_below(second), nm));
      least = std::min(least, in + out - apex);
    }
    EXPECT_NEAR(std::sin((apex + least) / 2) / std::sin(apex / 2), index(*glass, nm), 1e-5) << nm;
  }
}

// The rainbow: light mirrored once in a drop turns back by 42.4 degrees at most if it is red, 40.5 if violet.
TEST(RefractiveIndex, OfWaterMakesARainbow) {
  const auto water = make("dielectric", {text("glass", "water")});
  const auto bow = [&](std::int16_t nm) {
    double most = 0;
    for (int step = 0; step < 8900; ++step) {
      const double in = (0.5 + step * 0.01) * kDegree;
      const double inside = -angle(leaves(*water, from_above(in), nm));
      const double mirrored = -angle(leaves(*water, from_below(inside), nm, true));
      const double out = -angle(leaves(*water, from_below(mirrored), nm));
      most = std::max(most, 2 * (inside + mirrored) - in - out);
    }
    return most / kDegree;
  };
  EXPECT_NEAR(bow(700), 42.4, 0.15);
  EXPECT_NEAR(bow(400), 40.5, 0.15);
}

// What is mirrored outside keeps all colours; from inside, and beyond, light takes on its hue, once.
TEST(Dispersion, ColoursWhatIsRefractedOnce) {
  for (const char* type : {"dielectric", "principled"})
    for (const float rough : {0.f, 0.5f}) {
      std::vector<Param> params{text("glass", "SF11"), number("roughness", rough)};
      if (type == std::string("principled")) params.push_back(number("transmission", 1));
      if (type == std::string("principled")) params.push_back(rgb("basecolor", Rgb(1)));
      const auto glass = make(type, params);
      const auto weights = [&](Wavelength wavelength, const Vec3& wo, bool mirrored) {
        SurfacePoint point = surface();
        point.wavelength = wavelength;
        BsdfSlot slot;
        const Bsdf& bsdf = glass->bsdf(point, slot);
        const auto s = bsdf.sample(wo, {0.3f, 0.4f, mirrored ? 0.f : 0.5f}, Transport::radiance, bsdf.all_lobes());
        EXPECT_TRUE(s.has_value());
        if (!s->specular) {
          EXPECT_EQ(s->by_wavelength, bsdf.disperses(wo, s->wi));
        }
        EXPECT_EQ(s->wi.z * wo.z > 0, mirrored);
        return s->weight;
      };
      const Vec3 above = from_above(0.3), below = from_below(0.2);
      const auto ratio_is_hue = [](const Spectrum& weight, const Spectrum& plain, bool hued) {
        const Spectrum expected = hued ? hue(450) : Spectrum(1);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(weight[c], plain[c] * expected[c], 1e-4f);
      };
      const Wavelength light{.nm = 450}, camera{.nm = 450, .weighs = true}, coloured{450, true, true};
      for (const bool mirrored : {false, true}) {
        ratio_is_hue(weights(camera, above, mirrored), weights(light, above, mirrored), !mirrored);
        ratio_is_hue(weights(camera, below, mirrored), weights(light, below, mirrored), true);
      }
      ratio_is_hue(weights(coloured, above, false), weights(light, above, false), false);
      ratio_is_hue(weights(coloured, below, true), weights(light, below, true), false);
    }
}

}  // namespace
}  // namespace dspm::test
