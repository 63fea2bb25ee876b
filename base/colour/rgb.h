// Linear RGB with Rec. 709 primaries: radiance, flux or reflectance, as the name says.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace dspm {

struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
  constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

  float operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
  float& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }
  Rgb& operator+=(const Rgb& o) {
    r += o.r, g += o.g, b += o.b;
    return *this;
  }
  Rgb& operator*=(const Rgb& o) {
    r *= o.r, g *= o.g, b *= o.b;
    return *this;
  }
  Rgb& operator*=(float s) {
    r *= s, g *= s, b *= s;
    return *this;
  }
  friend bool operator==(const Rgb&, const Rgb&) = default;
};
inline Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
inline Rgb operator-(const Rgb& a, const Rgb& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline Rgb operator*(Rgb a, const Rgb& b) { return a *= b; }
inline Rgb operator*(Rgb a, float s) { return a *= s; }
inline Rgb operator*(float s, Rgb a) { return a *= s; }
inline Rgb operator/(const Rgb& a, float s) { return {a.r / s, a.g / s, a.b / s}; }

/// Divides each component, with 0 / 0 = 0; returns nullopt if a component is not finite.
inline std::optional<Rgb> ratio(const Rgb& a, const Rgb& b) {
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    result[c] = a[c] == 0 ? 0 : a[c] / b[c];
    if (!std::isfinite(result[c])) return std::nullopt;
  }
  return result;
}

inline bool is_black(const Rgb& c) { return c.r == 0 && c.g == 0 && c.b == 0; }
inline float max_component(const Rgb& c) { return std::max(c.r, std::max(c.g, c.b)); }
inline float mean(const Rgb& c) { return (c.r + c.g + c.b) / 3; }
inline float luminance(const Rgb& c) { return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b; }
inline bool is_finite(const Rgb& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

}  // namespace dspm
