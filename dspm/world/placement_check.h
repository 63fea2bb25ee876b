// Placements that cannot be used: keys may be sound, and what lies between them, or several of them multiplied, not.
#pragma once

#include <string>
#include <vector>

#include "dspm/lang/description.h"
#include "dspm/math/frames.h"
#include "dspm/params/errors.h"
#include "dspm/world/timeline.h"

namespace dspm {

/// Has an inverse in single precision as well.
bool is_sound(const Matrix4& matrix);

/// `light "point"` or the like is not placed in the frames in which the matrix is a scale of 0, with a note, nor, after
/// an error, in those in which it has no inverse: they become absent.
void leave_out_unplaced(Timeline<Matrix4>& matrices, const FileFrames& frames, const std::string& subject,
                        const SourceLocation& where, Diagnostics& diagnostics);

/// The error for a matrix that has no inverse.
void report_singular(const std::string& subject, const std::string& frame, const SourceLocation& where,
                     Diagnostics& diagnostics);

}  // namespace dspm
