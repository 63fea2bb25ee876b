// An iteration of an integrator, as a value: whatever differs from one iteration to the next comes in here.
#pragma once

#include <optional>
#include <span>

#include "dspm/integrators/moment_pixels.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct Iteration {
  int number;  // from 0; its random numbers are those of this number
  /// The scene that the integrator was made for, or its state in this iteration, with the same frames, shapes, materials
  /// and lights. It lives as long as the iteration.
  const Scene& scene;
  std::optional<double> delay = {};  // frames after their moments that it shows; none: all iterations have one scene
  /// The scenes of its moments, the first of which is `scene`: each pixel's camera path sees one of them. Empty: `scene` alone.
  std::span<const Scene* const> moments = {};

  /// Calls fn(const Scene&, const MomentPixels&) for each moment with the pixels that see it.
  template <class Fn>
  void for_each_moment(Fn&& fn) const {
    if (moments.empty()) return fn(scene, MomentPixels{});
    const auto count = static_cast<int>(moments.size());
    for (int moment = 0; moment < count; ++moment)
      fn(*moments[static_cast<std::size_t>(moment)], MomentPixels{moment, count});
  }
};

}  // namespace dspm
