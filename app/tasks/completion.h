// Shells that complete the options of dspm.
#pragma once

#include <string>
#include <vector>

namespace dspm {

/// The shells that completion_for() knows.
std::vector<std::string> completing_shells();
/// Returns the script that makes the shell complete dspm's command lines.
std::string completion_for(const std::string& shell);

}  // namespace dspm
