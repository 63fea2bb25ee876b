// Media whose scattering has been measured, by the names that pbrt gives them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "dspm/base/params/params.h"

namespace dspm {

/// Coefficients per millimetre, for red, green and blue.
struct MeasuredMedium {
  std::string_view name;
  float sigma_s[3];  // reduced: as if light were scattered alike in all directions
  float sigma_a[3];
};

std::span<const MeasuredMedium> measured_media();

/// Returns the medium of that name, the value of the reader's parameter `param`; null after an error.
const MeasuredMedium* find_measured_medium(ParamReader& reader, std::string_view param, const std::string& name);

}  // namespace dspm
