// The choices that made a frame, by name: for the names of its images, and for tables of them.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/session/job/job.h"

namespace dspm {

/// An axis of variations and what was chosen of it.
struct NamedPart {
  std::string name, text;
};

/// Returns the frame's choices, by axis, after the whole "variation".
std::vector<NamedPart> parts_of(const Job& job, FileFrame frame);

}  // namespace dspm
