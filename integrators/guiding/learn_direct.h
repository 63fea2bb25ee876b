// Learns how photons and rays should share the search for direct light, from what pilot rays of the camera find.
#pragma once

#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct LearnedDirect {
  float radius = 0;         // of a typical hit point: the median, initially
  float photons_a_ray = 1;  // see DirectWays
  bool by_rays = true;      // false: photons find so much that rays are not worth their time

  /// Loading throws std::runtime_error if the values are not possible.
  void persist(StateStream& state);
};

/// Learns from a scene whose frames stand for the file. An iteration traces `photons` paths, drawn with the guides.
/// Sets `bytes` to the most that it took.
LearnedDirect learn_direct(const Scene& sample, const RenderSettings& render, const HitPointSettings& settings,
                           std::int64_t photons, const EmissionGuides& guides, std::size_t& bytes);

}  // namespace dspm
