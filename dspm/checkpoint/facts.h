// What a render depends on: a checkpoint keeps it, so that a render is never continued with another scene.
#pragma once

#include <string>
#include <vector>

#include "dspm/world/job.h"

namespace dspm {

/// Something that the images depend on; `text` is what it is, or a digest of it.
struct Fact {
  std::string name, text;
  bool is_digest = false;
  SourceLocation where = {};  // in the scene; not kept in checkpoints
};

/// After the world was made: the files that were read for it are among them. What changes no pixel is not (names of
/// images, iterations to go, threads, the accelerator), nor is the memory bound, which changes rounding only.
std::vector<Fact> facts_of(const Job& job);

/// An error for each that is not the same, or is there in one only; in the order of `now`, then what it lacks.
void compare(const std::vector<Fact>& then, const std::vector<Fact>& now, Diagnostics& diagnostics);

}  // namespace dspm
