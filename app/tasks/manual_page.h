// The manual page dspm(1).
#pragma once

#include <string>

namespace dspm {

/// Returns the page as troff, with all options as --help knows them. [man(7)]
std::string manual_page();

}  // namespace dspm
