// The tree over everything that is there in all frames, on Embree. Embree culls boxes; what a ray meets, our own test
// decides, so that a hit is the same bit by bit whichever tree finds it. Meshes that stand in world space are handed
// over as packets of triangles. Shapes that a transform places are few and go into a tree as the dynamic ones have.
#pragma once

#include <atomic>
#include <memory>

#include "accel/dynamic_tree.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace dspm {

class StaticTree {
 public:
  /// Over shapes[i] for all i in `which`.
  StaticTree(std::span<const PlacedShape> shapes, const ShapesByKind& which, FrameSet all);

  /// Offers the nearest hit, which is the same in all frames.
  void find(const Ray& ray, NearestHit& query) const;
  bool occluded(const Ray& ray) const;
  std::size_t memory() const;

 private:
  struct Release {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
  };
  void build();
  bool in_reach(const Ray& ray) const { return max_component(abs(ray.origin)) <= reach_; }

  TriangleTree meshes_;  // also the tree for rays that Embree is not sure enough about
  DynamicTree others_;
  float margin_ = 0;                              // of the boxes that Embree is given
  float reach_ = -1;                              // from where that margin is large enough
  std::atomic<std::ptrdiff_t> embree_bytes_ = 0;  // Embree's own threads count them
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;  // over the packets of meshes_
};

}  // namespace dspm
