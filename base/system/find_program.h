// Other programs, looked up in PATH as they would be to run them.
#pragma once

#include <string>

namespace dspm {

/// Returns the path of the program, or an empty string if there is none.
std::string find_program(const std::string& name);

}  // namespace dspm
