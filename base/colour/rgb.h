// Linear RGB with Rec. 709 primaries: what authors and images say of radiance, flux or reflectance, as the name says.
#pragma once

#include "dspm/base/colour/componentwise.h"

namespace dspm {

struct Rgb : Componentwise<Rgb> {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
  constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

  constexpr float operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
  constexpr float& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};
static_assert(sizeof(Rgb) == 12);

constexpr float luminance(const Rgb& c) { return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b; }

}  // namespace dspm
