#include "dspm/output/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "dspm/base/colour/colour_space.h"
#include "dspm/image/encoding.h"

namespace dspm {
namespace {

constexpr std::string_view kOcio = "ocio";

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

/// The part of `light` that a surface of coverage `alpha` can show without being brighter than 1.
Rgb covered_part(const Rgb& light, float alpha) {
  const float brightest = max_component(light);
  return brightest > alpha ? light * (alpha / brightest) : light;
}

/// What the view makes of a pixel's light: of all of it, of its straight colour, of what its alpha covers.
struct Shown {
  Rgb all, straight, covered;
};

/// A pixel may hold light where next to no surface is: caustics on a catcher, fog before nothing. Over black, it shows as it
/// would without alpha, which grows by as much, so that over white nothing becomes darker. At edges, which have more alpha,
/// that would be a line in the colour of a bright surface before it fades to white.
std::pair<Rgb, float> straight_with_added_light(const Shown& shown, float alpha) {
  constexpr float kEdge = 1.f / 16;
  const float share = std::max(0.f, 1 - alpha / kEdge);
  Rgb added;
  for (int c = 0; c < 3; ++c)
    added[c] = share * std::max(0.f, shown.all[c] - std::max(shown.covered[c], alpha * shown.straight[c]));
  const float whole = std::min(alpha + max_component(added), 1.f);
  return {whole > 0 ? (alpha * shown.straight + added) / whole : Rgb(), whole};
}

}  // namespace

Rgb parse_background(const std::string& text) {
  if (text == "white") return Rgb(1);
  if (text == "black") return Rgb();
  unsigned number = 0;
  const char* const end = text.data() + text.size();
  const bool is_number = text.size() == 7 && text[0] == '#' && text[1] != '-' &&
                         std::from_chars(text.data() + 1, end, number, 16).ptr == end;
  if (!is_number) throw std::runtime_error("a background is white, black or #rrggbb");
  const auto linear = [](unsigned byte) { return srgb_to_linear(static_cast<float>(byte & 255) / 255); };
  return {linear(number >> 16), linear(number >> 8), linear(number)};
}

std::vector<std::string> view_names() {
  std::vector<std::string> names;
  for (const auto& [curve, name] : kViewNames) names.emplace_back(name);
  return names;
}

View::View(const ViewSettings& settings)
    : curve_(kUsualView),
      gain_(static_cast<float>(std::exp2(settings.stops))),
      format_{settings.png_bits, settings.display_p3 ? PngSpace::display_p3 : PngSpace::srgb},
      background_(settings.background) {
  if (settings.view.empty()) return;
  if (settings.view == kOcio || settings.view.starts_with("ocio:")) {
    ocio_ = ocio_view(settings.view);
    return;
  }
  const std::optional<ViewCurve> curve = view_curve(settings.view);
  if (!curve)
    throw std::runtime_error(fmt::format("there is no view \"{}\"; there are {}, ocio and ocio:DISPLAY/VIEW",
                                         settings.view, fmt::join(view_names(), ", ")));
  curve_ = *curve;
  if (curve_ == ViewCurve::raw && settings.display_p3)
    throw std::runtime_error("\"raw\" numbers are of Rec. 709, not of Display P3");
  if (curve_ == ViewCurve::raw) format_.space = PngSpace::linear;
}

void View::apply(std::vector<Rgb>& radiance) const {
  const bool p3 = format_.space == PngSpace::display_p3;
  for (Rgb& pixel : radiance) {
    if (!ocio_) pixel = curved(curve_, pixel);
    if (!ocio_ && p3) pixel = p3_from_rec709() * pixel;
  }
  if (!ocio_ || radiance.empty()) return;
  Image row(static_cast<int>(radiance.size()), 1);
  row.pixels = std::move(radiance);
  ocio_->apply(row);
  radiance = std::move(row.pixels);
}

Image View::with_alpha(Image image) const {
  std::vector<std::size_t> bright;  // pixels with more light than their alpha covers
  std::vector<Rgb> all, covered;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    Rgb& pixel = image.pixels[i];
    float& alpha = image.alpha[i];
    pixel *= gain_;
    alpha = alpha > 0 ? std::min(alpha, 1.f) : 0.f;
    if (alpha < 1 && max_component(pixel) > alpha)
      bright.push_back(i), all.push_back(pixel), covered.push_back(covered_part(pixel, alpha));
    pixel = alpha > 0 ? pixel / alpha : Rgb();
  }
  apply(image.pixels), apply(all), apply(covered);
  for (std::size_t k = 0; k < bright.size(); ++k) {
    const std::size_t i = bright[k];
    std::tie(image.pixels[i], image.alpha[i]) =
        straight_with_added_light({all[k], image.pixels[i], covered[k]}, image.alpha[i]);
  }
  return image;
}

Image View::cut_out(Image radiance) const {
  return background_ || radiance.alpha.empty() ? shown(std::move(radiance)) : with_alpha(std::move(radiance));
}

Image View::shown(Image radiance) const {
  if (radiance.alpha.empty() || !background_) {
    radiance.alpha.clear();
    for (Rgb& pixel : radiance.pixels) pixel *= gain_;
    apply(radiance.pixels);
    return radiance;
  }
  return flattened(with_alpha(std::move(radiance)));
}

Image View::flattened(Image image) const {
  Rgb background = background_.value_or(Rgb());
  if (format_.space == PngSpace::display_p3) background = p3_from_rec709() * background;
  for (std::size_t i = 0; i < image.alpha.size(); ++i)
    image.pixels[i] = image.alpha[i] * image.pixels[i] + (1 - image.alpha[i]) * background;
  image.alpha.clear();
  return image;
}

View View::for_video() const {
  View view = *this;
  view.format_ = {};
  return view;
}

}  // namespace dspm
