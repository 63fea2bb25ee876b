// dspm's version; CMakeLists.txt reads it from here.
#pragma once

#include <string_view>

namespace dspm {

inline constexpr std::string_view kVersion = "0.3.0";

/// Returns the number in place 0, 1 or 2: major, minor or patch.
constexpr unsigned version_part(int place) {
  unsigned number = 0;
  for (const char c : kVersion) {
    if (c == '.')
      --place;
    else if (place == 0)
      number = 10 * number + static_cast<unsigned>(c - '0');
  }
  return number;
}

}  // namespace dspm
