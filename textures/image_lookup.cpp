#include "dspm/textures/image_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/image/image.h"

namespace dspm {
namespace {

/// Returns a Gaussian of the squared distance from the middle (0) to the ellipse (1), where it vanishes.
float gaussian(float distance2) {
  constexpr int kSteps = 1024;
  static const auto table = [] {
    constexpr float kSharpness = 2;
    std::array<float, kSteps + 1> values{};
    for (int i = 0; i <= kSteps; ++i)
      values[static_cast<std::size_t>(i)] =
          rounded::exp(-kSharpness * static_cast<float>(i) / kSteps) - rounded::exp(-kSharpness);
    return values;
  }();
  return table[static_cast<std::size_t>(distance2 * kSteps + 0.5f)];
}

float length(Vec2 v) { return rounded::hypot(v.x, v.y); }

}  // namespace

float ImageLookup::longest_side() const {
  const Image& image = picture_->level(0);
  return static_cast<float>(std::max(image.width, image.height));
}

PlainImage ImageLookup::picture(int level) const {
  const Image& image = picture_->level(level);
  return {.width = image.width,
          .height = image.height,
          .pixels = image.pixels.data(),
          .alpha = image.alpha.empty() ? nullptr : image.alpha.data(),
          .wrap = settings_.wrap,
          .wrap_v = settings_.wrap_v.value_or(settings_.wrap),
          .channel = settings_.channel,
          .blends = settings_.filter != ImageFilter::point};
}

template <class T>
T ImageLookup::at(const TextureCoordinates& c) const {
  const Vec2 st = picture(0).tamed(c.st);
  const Vec2 x = c.dstdx, y = c.dstdy;
  if (settings_.filter == ImageFilter::ewa)
    return length(x) < length(y) ? elliptical<T>(st, y, x) : elliptical<T>(st, x, y);
  const float width = 2 * std::max({std::abs(x.x), std::abs(x.y), std::abs(y.x), std::abs(y.y)});
  return at_level<T>(rounded::log2(width * longest_side()), st);
}

// The level whose pixels are as wide as the filter; below 0, minus infinity for a point, it is the picture itself.
template <class T>
T ImageLookup::at_level(float level, Vec2 st) const {
  const int last = picture_->levels() - 1;
  if (level >= static_cast<float>(last) && last > 0) return picture(last).pixel<T>(0, 0);
  const float at_least_0 = std::max(level, 0.f);
  const int i = static_cast<int>(at_least_0);
  if (settings_.filter == ImageFilter::point) return picture(i).nearest<T>(st);
  if (settings_.filter == ImageFilter::bilinear || !(level > 0)) return picture(i).bilinear<T>(st);
  const float share = at_least_0 - static_cast<float>(i);
  return picture(i).bilinear<T>(st) * (1 - share) + picture(i + 1).bilinear<T>(st) * share;
}

// The elliptical weighted average. [Heckbert 1989, Fundamentals of Texture Mapping and Image Warping; Pharr, Jakob,
// Humphreys, Physically Based Rendering, 10.4.4]
template <class T>
T ImageLookup::elliptical(Vec2 st, Vec2 longer, Vec2 shorter) const {
  const float long_side = length(longer);
  float short_side = length(shorter);
  if (!(short_side > 0)) return picture(0).bilinear<T>(st);
  if (const float least = long_side / settings_.max_anisotropy; short_side < least) {
    shorter = shorter * (least / short_side);
    short_side = least;
  }
  const float level = std::max(rounded::log2(short_side * longest_side()), 0.f);
  const int last = picture_->levels() - 1;
  if (level >= static_cast<float>(last)) return last > 0 ? picture(last).pixel<T>(0, 0) : picture(0).bilinear<T>(st);
  const int i = static_cast<int>(level);
  const float share = level - static_cast<float>(i);
  const T coarser = share > 0 ? elliptical<T>(i + 1, st, longer, shorter) * share : T(0);
  return elliptical<T>(i, st, longer, shorter) * (1 - share) + coarser;
}

template <class T>
T ImageLookup::elliptical(int level, Vec2 st, Vec2 longer, Vec2 shorter) const {
  const PlainImage image = picture(level);
  const Vec2 centre = image.in_pixels(st) - Vec2{0.5f, 0.5f};
  longer = image.in_pixels(longer), shorter = image.in_pixels(shorter);
  // The ellipse A s^2 + B s t + C t^2 < 1 in pixels, widened by one so that it always covers some.
  float A = longer.y * longer.y + shorter.y * shorter.y + 1, C = longer.x * longer.x + shorter.x * shorter.x + 1;
  float B = -2 * (longer.x * longer.y + shorter.x * shorter.y);
  const float F = A * C - B * B / 4;
  A /= F, B /= F, C /= F;
  const float determinant = 4 * A * C - B * B, reach = 2 * std::sqrt(A / determinant);
  T sum(0);
  float weights = 0;
  for (int y = static_cast<int>(std::ceil(centre.y - reach)); static_cast<float>(y) <= centre.y + reach; ++y) {
    const float t = static_cast<float>(y) - centre.y;
    const float middle = centre.x - B * t / (2 * A),
                half = std::sqrt(std::max(0.f, 4 * A - determinant * t * t)) / (2 * A);
    for (int x = static_cast<int>(std::ceil(middle - half)); static_cast<float>(x) <= middle + half; ++x) {
      const float s = static_cast<float>(x) - centre.x, distance2 = A * s * s + B * s * t + C * t * t;
      if (!(distance2 < 1)) continue;
      const float weight = gaussian(std::max(distance2, 0.f));
      sum += image.pixel<T>(x, y) * weight, weights += weight;
    }
  }
  return weights > 0 ? sum * (1 / weights) : image.nearest<T>(st);
}

template float ImageLookup::at<float>(const TextureCoordinates&) const;
template Rgb ImageLookup::at<Rgb>(const TextureCoordinates&) const;

}  // namespace dspm
