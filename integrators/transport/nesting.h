// Nested bodies: where they overlap, the one of the highest priority is there. The surface of another one is not there
// within it: a path goes straight on, and neither this nor what lies on both sides of it counts as a segment of its
// own. A surface that is there refracts from the body of highest priority on the one side to that on the other.
// [Schmidt and Budge 2002, Simple Nested Dielectrics in Ray Traced Images]
//
// Between bodies of equal priority nothing is known of which is there. Their surfaces are then as written, each with
// the index of its own body over whatever is around it, and the body that was entered last is there. So scenes may
// model boundaries instead of bodies: a bubble is a body of index 1 / 1.5 in glass, and the boundary between glass and
// water has a material of its own. A path then leaves bodies that it has not entered; it forgets those of equal
// priority, as it must have left them at the same boundary.
#pragma once

#include <array>
#include <span>

#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/overlap.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/inside.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Calls fn(FrameSet, std::span<const Material* const>) for each combination of the bodies' states among `frames`, with
/// null where a state bounds no body.
template <class Fn>
void for_each_nesting(const Scene& scene, std::span<const int> bodies, FrameSet frames, Fn&& fn) {
  std::array<const Material*, Inside::kMost + 1> states;
  const auto choose = [&](const auto& self, std::size_t i, FrameSet left) -> void {
    if (left.empty()) return;
    if (i == bodies.size()) return fn(left, std::span<const Material* const>(states.data(), i));
    FrameSet others = left;
    scene.materials[static_cast<std::size_t>(bodies[i])].for_each(left, [&](FrameSet common, const Material& material) {
      states[i] = material.bounds_a_body() ? &material : nullptr;
      self(self, i + 1, common);
      others = others - common;
    });
    states[i] = nullptr;
    self(self, i + 1, others);
  };
  choose(choose, 0, frames);
}

/// A surface as a path meets it, in some frames.
struct Boundary {
  FrameSet frames;
  bool is_there;    // else it lies in a body of higher priority
  Inside arriving;  // the bodies that the path's segment lay in
  // See SurfacePoint.
  float outside_eta = 1, outside_dispersion = 1;

  bool is_like(const Boundary& o) const {
    return is_there == o.is_there && outside_eta == o.outside_eta && outside_dispersion == o.outside_dispersion &&
           arriving == o.arriving;
  }
};

/// Returns what the surface is to a path that has arrived from within `inside`: one boundary, unless frames differ in
/// it.
FrameArray<Boundary> boundaries_of(const Scene& scene, const Vertex& vertex, const Inside& inside);

}  // namespace dspm
