// The tree over everything that is there in all frames, on Embree. Embree sorts and bounds; what a ray meets, our own
// tests decide, so that a hit is the same bit by bit whichever tree finds it. Meshes in world space are handed over as
// packets of triangles; shapes that a transform places are few and go into a tree as the dynamic ones have.
#pragma once

#include "accel/dynamic_tree.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace dspm {

class StaticTree {
 public:
  /// Over shapes[i] for all i in `which`.
  StaticTree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all);
  ~StaticTree();

  /// Offers the nearest hit, for all of the query's frames.
  void find(const Ray& ray, NearestHit& query) const;
  bool occluded(const Ray& ray) const;
  std::size_t memory() const;
 private:
  DynamicTree all_;
};

}  // namespace dspm
