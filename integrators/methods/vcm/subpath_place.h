// The vertices of subpaths, on surfaces and in media, as connections, merges and their weights see them. A density by area is
// one by volume in a medium: it has no cosine. How often paths collide, and what media leave of light, is left out of all
// densities: each way to find a path has the same collisions, and a weight may be any function of the path.
#pragma once

#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/methods/vcm/subpath_weights.h"
#include "dspm/integrators/transport/medium_vertex.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/integrators/transport/scattering_place.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the factor of a density by area to one by solid angle, without the distance.
inline float area_cosine(const Vertex& vertex, const Vec3& w) { return std::abs(dot(w, vertex.point.ng)); }
inline float area_cosine(const MediumVertex&, const Vec3&) { return 1; }

inline Ray segment_from(const Vertex& vertex, const Vec3& w, float length) { return vertex.point.spawn(w, length); }
inline Ray segment_from(const MediumVertex& vertex, const Vec3& w, float length) { return {vertex.point, w, length}; }

inline bool is_caught(const Scene& scene, const Vertex& vertex) { return scene.is_catcher(vertex.hit.shape); }
inline bool is_caught(const Scene&, const MediumVertex&) { return false; }

/// Vertices on curves are not merged: being hit by a light subpath is not a density over the points of a surface that
/// turns to each ray, so light subpaths end there. Points of media are merged within a ball; both subpaths collide there, which
/// counts as often as the majorant says, the same in all frames.
inline VcmWays ways_at(const VcmWays& ways, const Vertex& vertex) {
  return vertex.point.turns ? ways.with_merging(0) : ways;
}
inline VcmWays ways_at(const VcmWays& ways, const MediumVertex& vertex) {
  return ways.with_merging(ways.merging_in_media * (vertex.majorant[0] + vertex.majorant[1] + vertex.majorant[2]) / 3);
}

}  // namespace dspm
