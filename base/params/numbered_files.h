// Sequences of files: names that hold a frame's number, `"string filename" "wave.%03d.ply"`.
#pragma once

#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"

namespace dspm {

bool has_numbered_file(const ParamList& list);
/// Returns the list with only the numbered files of these moments (ascending, not empty): each holds until the next,
/// the first also before.
ParamList holding_files_of(const ParamList& list, const std::vector<Moment>& moments);

/// Counts the numbered files from that frame on: it has the "first" of them, by default the one of its own number.
void count_files_from(Moment first, ParamList& list);

}  // namespace dspm
