// Surfaces and points of media in the same words, as places where paths are scattered.
#pragma once

#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/medium_vertex.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/integrators/transport/phase_bsdf.h"

namespace dspm {

/// Returns the length of the segment that has arrived.
inline float length_to(const Vertex& vertex) { return vertex.hit.t; }
inline float length_to(const MediumVertex& vertex) { return vertex.distance; }

/// Calls fn(FrameSet, const Bsdf&) for each scattering function in these frames.
template <class Fn>
void for_each_scattering(const Vertex& vertex, FrameSet, Fn&& fn) {
  for_each_surface(vertex, fn);
}
template <class Fn>
void for_each_scattering(const MediumVertex& vertex, FrameSet frames, Fn&& fn) {
  for (const MediumVertex::State& state : vertex.states) {
    const FrameSet common = state.frames & frames;
    if (common.empty()) continue;
    BsdfSlot slot;
    fn(common, slot.emplace<PhaseBsdf>(state.albedo, state.phase));
  }
}

}  // namespace dspm
