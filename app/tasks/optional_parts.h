// What dspm does without if it is absent: libraries that a build may leave out, and other programs.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace dspm {

struct OptionalPart {
  std::string name;
  std::string use;                     // what it is for
  std::string source;                  // the Debian packages that bring it, or where else it comes from
  std::function<std::string()> fault;  // why it cannot be used; empty: it can
  bool is_built = true;                // the build has it; nothing of it is loaded to know that
};

/// Returns the parts that a build has or lacks.
std::vector<OptionalPart> built_parts();
/// Returns other programs; their `fault` tries them, which takes a part of a second.
std::vector<OptionalPart> other_programs();

}  // namespace dspm
