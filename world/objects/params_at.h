// A directive's parameters in a frame, while the shutter may be open.
#pragma once

#include <cmath>
#include <variant>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/file_frames.h"

namespace dspm {

/// Returns the parameters at one of the moments of `frames`. Files of a sequence are those of the moment that the frame is
/// named after: between frames there are none. (For meshes, see shape_state.h.)
inline ParamList params_at(const ParamList& params, const FileFrames& frames, Moment moment) {
  if (!params.is_keyed()) return params;
  ParamList result = params.at(moment);
  if (frames.delay() == 0) return result;
  const ParamList whole = params.at(Moment(std::round(moment.frames() - frames.delay())));
  for (Param& param : result.params)
    if (const Param* const named = whole.find(param.name); named != nullptr && param.type == ParamType::text)
      param.values = named->values;
  return result;
}

}  // namespace dspm
