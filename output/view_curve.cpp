#include "dspm/output/view_curve.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/math/rounded.h"
#include "dspm/image/encoding.h"

namespace dspm {
namespace {

constexpr float kBright = 1e6f;  // far beyond every curve's white, and finite when squared

float clipped(float v) { return std::min(v, 1.f); }

template <class Curve>
Rgb each(const Rgb& c, const Curve& curve) {
  return {curve(c.r), curve(c.g), curve(c.b)};
}

Rgb within_one(const Rgb& c) {
  return each(c, [](float v) { return std::clamp(v, 0.f, 1.f); });
}

/// [Hable 2010, Filmic Tonemapping Operators] The film of Uncharted 2: his shoulder, linear part and toe, an exposure of
/// 2, and white at 11.2.
float filmic(float v) {
  const auto film = [](float x) {
    constexpr float a = 0.15f, b = 0.5f, c = 0.1f, d = 0.2f, e = 0.02f, f = 0.3f;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
  };
  constexpr float kWhite = 11.2f;
  return clipped(film(2 * std::min(v, 1e4f)) / film(kWhite));
}

/// [Sobotka, github.com/sobotka/AgX] Light is mixed a little, which takes colours off the edge of the gamut, and
/// brought from 2^-10 to 2^6.5 times middle grey onto 0..1.
constexpr ColourMatrix kInset = {{{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                  {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                  {0.0423756549057051, 0.0784336, 0.879142973793104}}};
constexpr ColourMatrix kOutset = {{{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                   {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                   {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}}};
constexpr float kGrey = 0.18f, kStopsBelow = 10, kStopsAbove = 6.5f;

/// Its sigmoid: through (0, 0), (1, 1) and grey at (20/33, 1/2), there with slope 2; 3 and 3.25 say how hard it bends.
float agx_sigmoid(float x) {
  constexpr float kPivot = kStopsBelow / (kStopsBelow + kStopsAbove), kSlope = 2, kToe = 3, kShoulder = 3.25f;
  const float power = x < kPivot ? kToe : kShoulder, reach = x < kPivot ? kPivot : 1 - kPivot;
  const float bend = (rounded::pow(2 * kSlope * reach, power) - 1) / rounded::pow(reach, power);
  return 0.5f + kSlope * (x - kPivot) / rounded::pow(1 + bend * rounded::pow(std::abs(x - kPivot), power), 1 / power);
}

/// [ASC CDL 1.2] Slope, power and saturation of a look; no look of AgX has an offset.
struct Look {
  Rgb slope = Rgb(1);
  float power = 1, saturation = 1;
};
/// [Wrensch 2023, Minimal AgX Implementation]
constexpr Look kPunchy = {Rgb(1), 1.35f, 1.4f}, kGolden = {Rgb(1, 0.9f, 0.5f), 0.8f, 0.8f};

Rgb with_look(const Rgb& colour, const Look& look) {
  const Rgb c = each(look.slope * colour, [&](float v) { return rounded::pow(std::max(v, 0.f), look.power); });
  const float grey = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
  return Rgb(grey) + look.saturation * (c - Rgb(grey));
}

/// Its numbers are those of a screen; they end up in the file as they are, so sRGB's curve is taken off before it is put
/// on. A look comes before the outset, as in Wrensch's.
Rgb agx(const Rgb& radiance, const Look* look = nullptr) {
  Rgb bent = each(kInset * radiance, [](float v) {
    const float stops = rounded::log2(std::max(v / kGrey, 1e-10f));
    return agx_sigmoid(std::clamp((stops + kStopsBelow) / (kStopsBelow + kStopsAbove), 0.f, 1.f));
  });
  if (look != nullptr) bent = with_look(bent, *look);
  return each(within_one(kOutset * bent), srgb_to_linear);
}

/// [Khronos 2024, PBR Neutral Tone Mapper] Takes off what a dielectric mirrors of white surroundings, 0.04, so that base
/// colours come out as they are; compresses from 0.8 less that on; and what is compressed fades to white.
Rgb neutral(Rgb c) {
  constexpr float kMirrored = 0.04f, kStart = 0.8f - kMirrored, kFade = 0.15f;
  const float least = std::min({c.r, c.g, c.b});
  c = c - Rgb(least < 2 * kMirrored ? least - least * least / (4 * kMirrored) : kMirrored);
  const float peak = max_component(c);
  if (peak < kStart) return c;
  const float compressed = 1 - (1 - kStart) * (1 - kStart) / (peak + 1 - 2 * kStart);
  const float kept = 1 / (kFade * (peak - compressed) + 1);
  return kept * (compressed / peak) * c + Rgb((1 - kept) * compressed);
}

/// [Hill 2016, in Pettineo's BakingLab] To AP1 with the saturation of the reference rendering transform, a rational fit of that
/// and the output transform for sRGB, and back.
constexpr ColourMatrix kAcesIn = {{{0.59719, 0.35458, 0.04823}, {0.076, 0.90834, 0.01566}, {0.0284, 0.13383, 0.83777}}};
constexpr ColourMatrix kAcesOut = {
    {{1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07602}}};

Rgb aces(const Rgb& radiance) {
  const auto fit = [](float v) {
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.432951f) + 0.238081f);
  };
  return within_one(kAcesOut * each(kAcesIn * radiance, fit));
}

}  // namespace

std::optional<ViewCurve> view_curve(std::string_view name) {
  for (const auto& [curve, each] : kViewNames)
    if (each == name) return curve;
  return std::nullopt;
}

Rgb curved(ViewCurve curve, const Rgb& radiance) {
  const Rgb light = each(radiance, [](float v) { return v > 0 ? std::min(v, kBright) : 0.f; });
  switch (curve) {
    case ViewCurve::filmic: return each(light, filmic);
    case ViewCurve::agx: return agx(light);
    case ViewCurve::agx_punchy: return agx(light, &kPunchy);
    case ViewCurve::agx_golden: return agx(light, &kGolden);
    case ViewCurve::neutral: return within_one(neutral(light));
    case ViewCurve::aces: return aces(light);
    case ViewCurve::standard:
    case ViewCurve::raw: break;
  }
  return each(light, clipped);
}

}  // namespace dspm
