// Photons on mixes: they count for the points around them, whichever material these are made of.
#pragma once

#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/materials/mix.h"

namespace dspm {

/// Returns the frames in which the vertex lies on a mix and `holds(const Bsdf&)` is true of one of its materials there.
template <class Holds>
FrameSet mixed_frames(const Vertex& vertex, Holds&& holds) {
  FrameSet frames;
  vertex.material.for_each(vertex.frames, [&](FrameSet in_state, const Material& state) {
    if (&state.at(vertex.point) == &state) return;
    const bool some = any_part(state, [&](const Material& part) {
      BsdfSlot slot;
      return holds(part.bsdf(vertex.point, slot));
    });
    if (some) frames |= in_state;
  });
  return frames;
}

}  // namespace dspm
