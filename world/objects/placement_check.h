// Placements that cannot be used: keys may be sound, but not what lies between them, nor the product of several.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/timeline.h"

namespace dspm {

/// Returns whether the matrix has an inverse in single precision as well.
bool is_sound(const Matrix4& matrix);

/// Makes `light "point"` or the like absent from the frames in which the matrix is a scale of 0, with a note, and,
/// after an error, from those in which it has no inverse.
void leave_out_unplaced(Timeline<Matrix4>& matrices, const FileFrames& frames, const std::string& subject,
                        const SourceLocation& where, Diagnostics& diagnostics);

/// Reports the error for a matrix that has no inverse.
void report_singular(const std::string& subject, const std::string& frame, const SourceLocation& where,
                     Diagnostics& diagnostics);

}  // namespace dspm
