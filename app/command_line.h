// The command line: its task and the exit code.
#pragma once

#include <string>
#include <vector>

namespace dspm {

/// Carries out what the arguments (without the program's name) ask for. Returns 0 if it is done, 1 after a scene or
/// render error, 2 after a usage error, 128 + signal after a signal.
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace dspm
