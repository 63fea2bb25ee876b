// Which pixels of a picture count at a point, and how much: plain values, which a device can have. image_lookup.h averages
// over footprints as well.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// The continuation of the picture outside of 0..1.
enum class Wrap { repeat, mirror, black, clamp, octahedral_sphere };

/// The part of a pixel that a lookup of a number takes. `usual` is the alpha of a picture that has one, else the mean
/// of red, green and blue; `alpha` is 1 if the picture has none.
enum class Channel { usual, red, green, blue, alpha };

/// A picture in one size. T is float or Rgb.
struct PlainImage {
  int width = 0, height = 0;
  const Rgb* pixels = nullptr;   // row by row from the top
  const float* alpha = nullptr;  // null: every pixel is opaque
  Wrap wrap = Wrap::repeat;      // along s
  Wrap wrap_v = Wrap::repeat;    // along t
  Channel channel = Channel::usual;
  bool blends = true;  // four pixels; false: takes one

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    fn(pixels, count);
    fn(alpha, count);
  }

  /// Returns the value at a point; (0, 0) is the picture's upper left corner.
  template <class T>
  constexpr T at(Vec2 st) const {
    return blends ? bilinear<T>(tamed(st)) : nearest<T>(tamed(st));
  }

  /// Returns coordinates that fit into integers, even if they were not finite.
  constexpr Vec2 tamed(Vec2 st) const { return {tamed(st.x, wrap), tamed(st.y, wrap_v)}; }

  template <class T>
  constexpr T nearest(Vec2 st) const {
    const Vec2 place = in_pixels(st);
    return pixel<T>(static_cast<int>(rounded::floor(place.x)), static_cast<int>(rounded::floor(place.y)));
  }

  // Pixel i covers i .. i + 1, so its centre is at i + 1/2.
  template <class T>
  constexpr T bilinear(Vec2 st) const {
    const Vec2 place = in_pixels(st) - Vec2{0.5f, 0.5f};
    const Vec2 first{rounded::floor(place.x), rounded::floor(place.y)}, share = place - first;
    const int x = static_cast<int>(first.x), y = static_cast<int>(first.y);
    return (pixel<T>(x, y) * (1 - share.x) + pixel<T>(x + 1, y) * share.x) * (1 - share.y) +
           (pixel<T>(x, y + 1) * (1 - share.x) + pixel<T>(x + 1, y + 1) * share.x) * share.y;
  }

  template <class T>
  constexpr T pixel(int x, int y) const {
    if (!wrap_pixel(x, y)) return T(0);
    const std::size_t index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    const Rgb& c = pixels[index];
    if constexpr (std::is_same_v<T, float>) {
      switch (channel) {
        case Channel::red: return c.r;
        case Channel::green: return c.g;
        case Channel::blue: return c.b;
        case Channel::alpha: return alpha == nullptr ? 1 : alpha[index];
        case Channel::usual: break;
      }
      return alpha == nullptr ? (c.r + c.g + c.b) / 3 : alpha[index];
    } else {
      return c;
    }
  }

  /// Returns coordinates from 0 to 1 as ones from 0 to the picture's size.
  constexpr Vec2 in_pixels(Vec2 st) const {
    return {st.x * static_cast<float>(width), st.y * static_cast<float>(height)};
  }

 private:
  static constexpr float tamed(float s, Wrap beyond) {
    // In this order of min and max, NaN becomes `low`.
    const auto between = [](float low, float x, float high) { return std::max(low, std::min(x, high)); };
    if (beyond == Wrap::repeat) return between(0, s - rounded::floor(s), 1);
    if (beyond == Wrap::mirror) return between(0, s - 2 * rounded::floor(s / 2), 2);
    return between(-4, s, 5);
  }

  static constexpr int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a - 1) / b) - 1; }

  /// Moves a pixel into the picture; returns false if it is black.
  constexpr bool wrap_pixel(int& x, int& y) const {
    if (0 <= x && x < width && 0 <= y && y < height) return true;
    if (wrap == Wrap::octahedral_sphere) return wrap_octahedrally(x, y), true;
    return wrap_along(x, width, wrap) && wrap_along(y, height, wrap_v);
  }

  /// Wraps a pixel: each edge of the square is joined to itself, turned about its middle.
  constexpr void wrap_octahedrally(int& x, int& y) const {
    const int across = floor_div(x, width), down = floor_div(y, height);
    x -= across * width, y -= down * height;
    if (across % 2 != 0) x = width - 1 - x, y = height - 1 - y;
    if (down % 2 != 0) x = width - 1 - x, y = height - 1 - y;
  }

  /// Moves a pixel into the picture along one side; returns false if it is black.
  static constexpr bool wrap_along(int& x, int size, Wrap beyond) {
    if (0 <= x && x < size) return true;
    const int across = floor_div(x, size);
    switch (beyond) {
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
};

}  // namespace dspm
