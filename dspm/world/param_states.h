// A shape's parameters over the frames of the file, and how messages call the shape.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "dspm/lang/description.h"
#include "dspm/math/frames.h"
#include "dspm/params/params.h"
#include "dspm/world/timeline.h"

namespace dspm {

/// The directive's parameters, state by state.
inline Timeline<ParamList> param_states(const ParamList& params, const FileFrames& frames,
                                        const std::vector<bool>& present) {
  const bool keyed = params.is_keyed();
  return Timeline<ParamList>::of_moments(
      frames, present, [&](Moment moment) { return keyed ? params.at(moment) : params; },
      [&](const ParamList& a, const ParamList& b) { return !keyed || a.same_values(b); });
}

inline std::string subject_of(const ShapeUse& use) { return fmt::format("shape \"{}\"", use.type); }

}  // namespace dspm
