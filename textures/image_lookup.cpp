#include "dspm/textures/image_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/image/image.h"

namespace dspm {
namespace {

int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a - 1) / b) - 1; }

/// Wraps a pixel: each edge of the square is joined to itself, turned about its middle.
void wrap_octahedrally(int& x, int& y, int width, int height) {
  const int across = floor_div(x, width), down = floor_div(y, height);
  x -= across * width, y -= down * height;
  if (across % 2 != 0) x = width - 1 - x, y = height - 1 - y;
  if (down % 2 != 0) x = width - 1 - x, y = height - 1 - y;
}

/// Moves a pixel into the picture along one side; returns false if it is black.
bool wrap_along(int& x, int size, Wrap wrap) {
  if (0 <= x && x < size) return true;
  const int across = floor_div(x, size);
  switch (wrap) {
    case Wrap::repeat: x -= across * size; return true;
    case Wrap::mirror:
      x -= across * size;
      if (across % 2 != 0) x = size - 1 - x;
      return true;
    case Wrap::clamp: x = std::clamp(x, 0, size - 1); return true;
    case Wrap::octahedral_sphere:
    case Wrap::black: break;
  }
  return false;
}

/// Moves a pixel into the picture; returns false if it is black.
bool wrap_pixel(int& x, int& y, const Image& image, Wrap wrap, Wrap wrap_v) {
  const int width = image.width, height = image.height;
  if (0 <= x && x < width && 0 <= y && y < height) return true;
  if (wrap == Wrap::octahedral_sphere) return wrap_octahedrally(x, y, width, height), true;
  return wrap_along(x, width, wrap) && wrap_along(y, height, wrap_v);
}

/// Returns a coordinate that fits into an integer, even if it was not finite.
float tamed(float s, Wrap wrap) {
  // In this order of min and max, NaN becomes `low`.
  const auto between = [](float low, float x, float high) { return std::max(low, std::min(x, high)); };
  if (wrap == Wrap::repeat) return between(0, s - std::floor(s), 1);
  if (wrap == Wrap::mirror) return between(0, s - 2 * std::floor(s / 2), 2);
  return between(-4, s, 5);
}

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

Vec2 operator*(Vec2 a, Vec2 b) { return {a.x * b.x, a.y * b.y}; }

float length(Vec2 v) { return rounded::hypot(v.x, v.y); }

Vec2 size_of(const Image& image) { return {static_cast<float>(image.width), static_cast<float>(image.height)}; }

}  // namespace

float ImageLookup::longest_side() const {
  const Image& image = picture_->level(0);
  return static_cast<float>(std::max(image.width, image.height));
}

template <class T>
T ImageLookup::pixel(int level, int x, int y) const {
  const Image& image = picture_->level(level);
  if (!wrap_pixel(x, y, image, settings_.wrap, settings_.wrap_v.value_or(settings_.wrap))) return T(0);
  if constexpr (std::is_same_v<T, float>) {
    const Rgb& c = image.at(x, y);
    switch (settings_.channel) {
      case Channel::red: return c.r;
      case Channel::green: return c.g;
      case Channel::blue: return c.b;
      case Channel::alpha: return image.alpha.empty() ? 1 : image.alpha[image.index(x, y)];
      case Channel::usual: break;
    }
    return image.alpha.empty() ? (c.r + c.g + c.b) / 3 : image.alpha[image.index(x, y)];
  } else {
    return image.at(x, y);
  }
}

template <class T>
T ImageLookup::nearest(int level, Vec2 st) const {
  const Vec2 place = st * size_of(picture_->level(level));
  return pixel<T>(level, static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
}

// Pixel i covers i .. i + 1, so its centre is at i + 1/2.
template <class T>
T ImageLookup::bilinear(int level, Vec2 st) const {
  const Vec2 place = st * size_of(picture_->level(level)) - Vec2{0.5f, 0.5f};
  const Vec2 first{std::floor(place.x), std::floor(place.y)}, share = place - first;
  const int x = static_cast<int>(first.x), y = static_cast<int>(first.y);
  return (pixel<T>(level, x, y) * (1 - share.x) + pixel<T>(level, x + 1, y) * share.x) * (1 - share.y) +
         (pixel<T>(level, x, y + 1) * (1 - share.x) + pixel<T>(level, x + 1, y + 1) * share.x) * share.y;
}

template <class T>
T ImageLookup::at(const TextureCoordinates& c) const {
  const Vec2 st{tamed(c.st.x, settings_.wrap), tamed(c.st.y, settings_.wrap_v.value_or(settings_.wrap))};
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
  if (level >= static_cast<float>(last) && last > 0) return pixel<T>(last, 0, 0);
  const float at_least_0 = std::max(level, 0.f);
  const int i = static_cast<int>(at_least_0);
  if (settings_.filter == ImageFilter::point) return nearest<T>(i, st);
  if (settings_.filter == ImageFilter::bilinear || !(level > 0)) return bilinear<T>(i, st);
  const float share = at_least_0 - static_cast<float>(i);
  return bilinear<T>(i, st) * (1 - share) + bilinear<T>(i + 1, st) * share;
}

// The elliptical weighted average. [Heckbert 1989, Fundamentals of Texture Mapping and Image Warping; Pharr, Jakob,
// Humphreys, Physically Based Rendering, 10.4.4]
template <class T>
T ImageLookup::elliptical(Vec2 st, Vec2 longer, Vec2 shorter) const {
  const float long_side = length(longer);
  float short_side = length(shorter);
  if (!(short_side > 0)) return bilinear<T>(0, st);
  if (const float least = long_side / settings_.max_anisotropy; short_side < least) {
    shorter = shorter * (least / short_side);
    short_side = least;
  }
  const float level = std::max(rounded::log2(short_side * longest_side()), 0.f);
  const int last = picture_->levels() - 1;
  if (level >= static_cast<float>(last)) return last > 0 ? pixel<T>(last, 0, 0) : bilinear<T>(0, st);
  const int i = static_cast<int>(level);
  const float share = level - static_cast<float>(i);
  const T coarser = share > 0 ? elliptical<T>(i + 1, st, longer, shorter) * share : T(0);
  return elliptical<T>(i, st, longer, shorter) * (1 - share) + coarser;
}

template <class T>
T ImageLookup::elliptical(int level, Vec2 st, Vec2 longer, Vec2 shorter) const {
  const Vec2 size = size_of(picture_->level(level)), centre = st * size - Vec2{0.5f, 0.5f};
  longer = longer * size, shorter = shorter * size;
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
      sum += pixel<T>(level, x, y) * weight, weights += weight;
    }
  }
  return weights > 0 ? sum * (1 / weights) : nearest<T>(level, st);
}

template float ImageLookup::at<float>(const TextureCoordinates&) const;
template Rgb ImageLookup::at<Rgb>(const TextureCoordinates&) const;

}  // namespace dspm
