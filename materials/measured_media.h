// Media whose scattering has been measured, by the names that pbrt gives them.
#pragma once

#include <span>
#include <string_view>

namespace dspm {

/// Coefficients per millimetre, for red, green and blue.
struct MeasuredMedium {
  std::string_view name;
  float sigma_s[3];  // reduced: as if light were scattered alike in all directions
  float sigma_a[3];
};

std::span<const MeasuredMedium> measured_media();

}  // namespace dspm
