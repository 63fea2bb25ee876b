// A shape's parameters over the frames of the file, and how messages call the shape.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/likeness.h"
#include "dspm/world/objects/params_at.h"
#include "dspm/world/objects/timeline.h"

namespace dspm {

/// Returns the directive's parameters, state by state.
inline Timeline<ParamList> param_states(ParamList params, const FileFrames& frames, const std::vector<bool>& present) {
  if (params.is_keyed())
    return Timeline<ParamList>::of_moments(
        frames, present, [&](Moment moment) { return params_at(params, frames, moment); },
        [](const ParamList& a, const ParamList& b) { return a.same_values(b); },
        [](const ParamList& list) { return Likeness().add(list).number(); });
  Timeline<ParamList> line;
  for (const bool is_there : present) line.state_of.push_back(is_there ? 0 : -1);
  if (std::find(present.begin(), present.end(), true) != present.end()) line.states.push_back(std::move(params));
  return line;
}

inline std::string subject_of(const ShapeUse& use) { return fmt::format("shape \"{}\"", use.type); }

}  // namespace dspm
