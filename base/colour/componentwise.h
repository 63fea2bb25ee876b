// Arithmetic of three numbers side by side, for types that mean different things by them: RGB colours, and what paths
// carry.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

namespace dspm {

/// Gives T, which derives from it and has three components by [], its operators. Types do not mix.
template <class T>
struct Componentwise {
  constexpr T& operator+=(const T& o) {
    return each(o, [](float& a, float b) { a += b; });
  }
  constexpr T& operator*=(const T& o) {
    return each(o, [](float& a, float b) { a *= b; });
  }
  constexpr T& operator*=(float s) {
    return each(self(), [s](float& a, float) { a *= s; });
  }

  friend constexpr T operator+(T a, const T& b) { return a += b; }
  friend constexpr T operator-(T a, const T& b) {
    return a.each(b, [](float& x, float y) { x -= y; });
  }
  friend constexpr T operator*(T a, const T& b) { return a *= b; }
  friend constexpr T operator*(T a, float s) { return a *= s; }
  friend constexpr T operator*(float s, T a) { return a *= s; }
  friend constexpr T operator/(T a, float s) {
    return a.each(a, [s](float& x, float) { x /= s; });
  }

 private:
  constexpr T& self() { return static_cast<T&>(*this); }
  template <class Change>
  constexpr T& each(const T& o, Change&& change) {
    T& t = self();
    change(t[0], o[0]), change(t[1], o[1]), change(t[2], o[2]);
    return t;
  }
  friend constexpr bool operator==(const Componentwise&, const Componentwise&) = default;
};

template <class T>
concept Components = std::derived_from<T, Componentwise<T>>;

template <Components T>
constexpr bool is_black(const T& c) {
  return c[0] == 0 && c[1] == 0 && c[2] == 0;
}
template <Components T>
constexpr float max_component(const T& c) {
  return std::max(c[0], std::max(c[1], c[2]));
}
template <Components T>
constexpr float mean(const T& c) {
  return (c[0] + c[1] + c[2]) / 3;
}
template <Components T>
constexpr bool is_finite(const T& c) {
  return std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]);
}
/// Returns fn of each component.
template <Components T, class Fn>
constexpr T map(const T& c, Fn&& fn) {
  return {fn(c[0]), fn(c[1]), fn(c[2])};
}
/// Divides each component, with 0 / 0 = 0; returns nullopt if a component is not finite.
template <Components T>
constexpr std::optional<T> ratio(const T& a, const T& b) {
  T result;
  for (int c = 0; c < 3; ++c) {
    result[c] = a[c] == 0 ? 0 : a[c] / b[c];
    if (!std::isfinite(result[c])) return std::nullopt;
  }
  return result;
}

}  // namespace dspm
