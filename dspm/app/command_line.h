// The command line: its task and the exit code.
#pragma once

#include <string>
#include <vector>

namespace dspm {

/// Carries out what the arguments (without the program's name) ask for. 0 done, 1 scene or render error, 2 usage, 128 +
/// signal.
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace dspm
