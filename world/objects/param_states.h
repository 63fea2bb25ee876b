// The states of a Shape directive over the frames of the file, and how messages call the shape.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/likeness.h"
#include "dspm/world/objects/shape_state.h"
#include "dspm/world/objects/timeline.h"

namespace dspm {

inline Timeline<ShapeState> param_states(ParamList params, const FileFrames& frames, const std::vector<bool>& present) {
  if (params.is_keyed())
    return Timeline<ShapeState>::of_moments(
        frames, present, [&](Moment moment) { return shape_state(params, frames, moment); },
        [](const ShapeState& a, const ShapeState& b) { return a.is_same(b); },
        [](const ShapeState& state) { return Likeness().add(state.params).number(); });
  Timeline<ShapeState> line;
  for (const bool is_there : present) line.state_of.push_back(is_there ? 0 : -1);
  if (std::find(present.begin(), present.end(), true) != present.end())
    line.states.push_back({std::move(params), frames.delay()});
  return line;
}

inline std::string subject_of(const ShapeUse& use) { return fmt::format("shape \"{}\"", use.type); }

}  // namespace dspm
