// What a path carries. A render in RGB carries red, green and blue; a spectral one carries values at three wavelengths,
// other ones in each iteration, over those of daylight: so white has the same value in all components either way. Only the
// iteration's Palette (palette.h) says which; whoever scatters light treats the components alike.
#pragma once

#include <algorithm>

#include "dspm/base/colour/componentwise.h"

namespace dspm {

struct Spectrum : Componentwise<Spectrum> {
  float v[3] = {0, 0, 0};

  constexpr Spectrum() = default;
  constexpr explicit Spectrum(float grey) : v{grey, grey, grey} {}
  constexpr Spectrum(float first, float second, float third) : v{first, second, third} {}

  constexpr float operator[](int i) const { return v[i]; }
  constexpr float& operator[](int i) { return v[i]; }
  friend constexpr bool operator==(const Spectrum&, const Spectrum&) = default;
};
static_assert(sizeof(Spectrum) == 12);

/// Clamps to what a surface can reflect, because a texture may exceed it.
constexpr Spectrum clamped_albedo(const Spectrum& c) {
  return map(c, [](float share) { return std::clamp(share, 0.f, 1.f); });
}

constexpr double sum(const Spectrum& c) {
  return static_cast<double>(c[0]) + static_cast<double>(c[1]) + static_cast<double>(c[2]);
}

}  // namespace dspm
