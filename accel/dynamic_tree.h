// The tree over everything that differs between frames: the project's own, as its nodes know in which frames their
// contents are there. Meshes that stand in world space are one tree of triangles. Everything else is placed by a
// transform: below a tree over the placed shapes hangs one tree for every distinct shape.
//
// A path that has split is in few frames, often in one: such a ray finds its way sooner in a tree over the meshes of
// its frame alone. Deforming meshes, each there in a frame or two, are therefore kept twice.
#pragma once

#include <memory>

#include "accel/shape_tree.h"

namespace dspm {

class DynamicTree {
 public:
  /// Over shapes[i] for all i in `which`.
  DynamicTree(std::span<const PlacedShape> shapes, const ShapesByKind& which, FrameSet all);

  bool empty() const { return placed_.empty() && meshes_.empty(); }
  /// Offers to `query` (NearestHit, NearestHits or Unblocked) what the ray meets.
  template <class Query>
  void find(const Ray& ray, Query& query) const;
  std::size_t memory() const;

 private:
  struct Placed {
    int number;  // among all placed shapes
    const PlacedShape* shape;
    const ShapeTree* tree;
  };
  template <class Query>
  static void find_in(const Placed& placed, const Ray& ray, Query& query);
  Bounds3 place(const Placed& placed);
  void build_single_frames(std::span<const PlacedShape> shapes, const std::vector<int>& meshes, FrameSet all);

  TriangleTree meshes_;
  std::vector<TriangleTree> of_frame_;  // the same meshes frame by frame; empty where they live too long for that
  std::vector<std::unique_ptr<ShapeTree>> shape_trees_;
  std::vector<Placed> placed_;  // by leaf
  Bvh bvh_;                     // over placed_
  float margins_ = 1;           // of a world ray's origin, see stretch_of()
};

}  // namespace dspm
