// The files of app/templates, as CMakeLists.txt puts them into the program.
#pragma once

#include <span>
#include <string_view>

namespace dspm {

struct Template {
  std::string_view file;  // without ".in"
  std::string_view text;  // with @words@ to be replaced
};
std::span<const Template> templates();

}  // namespace dspm
