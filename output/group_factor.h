// Reads what --relight says of a group of lights.
#pragma once

#include <string>

#include "dspm/base/colour/rgb.h"

namespace dspm {

/// The factor, brightness and colour, by which a group of lights is multiplied.
struct GroupFactor {
  std::string group;
  Rgb factor;
};

/// Reads "key 0.5", "key [1 .8 .6]" or both: "key 0.5 [1 .8 .6]". Throws UsageError.
GroupFactor parse_group_factor(const std::string& text);

}  // namespace dspm
