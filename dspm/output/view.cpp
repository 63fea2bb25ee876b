#include "dspm/output/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "dspm/colour/colour_space.h"
#include "dspm/image/encoding.h"

namespace dspm {
namespace {

constexpr std::pair<ViewCurve, const char*> kNames[] = {
    {ViewCurve::standard, "standard"}, {ViewCurve::filmic, "filmic"}, {ViewCurve::agx, "agx"}, {ViewCurve::raw, "raw"}};
constexpr std::string_view kOcio = "ocio";

float clipped(float v) { return std::min(v, 1.f); }

template <class Curve>
Rgb each(const Rgb& c, const Curve& curve) {
  return {curve(c.r), curve(c.g), curve(c.b)};
}

/// [Hable 2010, Filmic Tonemapping Operators] The film of Uncharted 2: his shoulder, linear part and toe, an exposure of
/// 2, and white at 11.2.
float filmic(float v) {
  const auto film = [](float x) {
    constexpr float a = 0.15f, b = 0.5f, c = 0.1f, d = 0.2f, e = 0.02f, f = 0.3f;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
  };
  constexpr float kWhite = 11.2f, kBright = 1e4f;
  return clipped(film(2 * std::min(v, kBright)) / film(kWhite));
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
  const float bend = (std::pow(2 * kSlope * reach, power) - 1) / std::pow(reach, power);
  return 0.5f + kSlope * (x - kPivot) / std::pow(1 + bend * std::pow(std::abs(x - kPivot), power), 1 / power);
}

/// Its numbers are those of a screen; they end up in the file as they are, so sRGB's curve is taken off before it is put
/// on.
Rgb agx(const Rgb& radiance) {
  const Rgb encoded = kOutset * each(kInset * radiance, [](float v) {
                        const float stops = std::log2(std::max(v / kGrey, 1e-10f));
                        return agx_sigmoid(std::clamp((stops + kStopsBelow) / (kStopsBelow + kStopsAbove), 0.f, 1.f));
                      });
  return each(encoded, [](float v) { return srgb_to_linear(std::clamp(v, 0.f, 1.f)); });
}

const ColourMatrix& p3_from_rec709() {
  static const ColourMatrix matrix =
      rgb_from_xyz(chromaticities(ColourSpace::dci_p3)) * xyz_from_rgb(chromaticities(ColourSpace::srgb));
  return matrix;
}

std::shared_ptr<const OcioView> ocio_view(std::string_view words) {
  words.remove_prefix(std::min(kOcio.size() + 1, words.size()));
  const std::size_t slash = words.find('/');
  if (slash == words.npos) return std::make_shared<OcioView>("", std::string(words));
  return std::make_shared<OcioView>(std::string(words.substr(0, slash)), std::string(words.substr(slash + 1)));
}

}  // namespace

std::vector<std::string> view_names() {
  std::vector<std::string> names;
  for (const auto& [curve, name] : kNames) names.emplace_back(name);
  return names;
}

View::View(const ViewSettings& settings)
    : curve_(kUsualView),
      gain_(static_cast<float>(std::exp2(settings.stops))),
      format_{settings.png_bits, settings.display_p3 ? PngSpace::display_p3 : PngSpace::srgb} {
  if (settings.view.empty()) return;
  if (settings.view == kOcio || settings.view.starts_with("ocio:")) {
    ocio_ = ocio_view(settings.view);
    return;
  }
  const auto* found =
      std::find_if(std::begin(kNames), std::end(kNames), [&](const auto& n) { return n.second == settings.view; });
  if (found == std::end(kNames))
    throw std::runtime_error(fmt::format("there is no view \"{}\"; there are {}, ocio and ocio:DISPLAY/VIEW",
                                         settings.view, fmt::join(view_names(), ", ")));
  curve_ = found->first;
  if (curve_ == ViewCurve::raw && settings.display_p3)
    throw std::runtime_error("\"raw\" numbers are of Rec. 709, not of Display P3");
  if (curve_ == ViewCurve::raw) format_.space = PngSpace::linear;
}

Rgb curved(ViewCurve curve, const Rgb& radiance) {
  const Rgb light = each(radiance, [](float v) { return v > 0 ? v : 0.f; });
  switch (curve) {
    case ViewCurve::filmic: return each(light, filmic);
    case ViewCurve::agx: return agx(each(light, [](float v) { return std::min(v, 1e6f); }));
    case ViewCurve::standard:
    case ViewCurve::raw: break;
  }
  return each(light, clipped);
}

Image View::shown(Image radiance) const {
  const bool p3 = format_.space == PngSpace::display_p3;
  for (Rgb& pixel : radiance.pixels) {
    pixel *= gain_;
    if (!ocio_) pixel = curved(curve_, pixel);
    if (!ocio_ && p3) pixel = p3_from_rec709() * pixel;
  }
  if (ocio_) ocio_->apply(radiance);
  return radiance;
}

View View::for_video() const {
  View view = *this;
  view.format_ = {};
  return view;
}

}  // namespace dspm
