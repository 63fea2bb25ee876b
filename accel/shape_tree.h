// A tree over the primitives of one shape, in the shape's own space: stored once, however often and wherever the shape
// is placed.
#pragma once

#include "accel/triangle_tree.h"

namespace dspm {

class ShapeTree {
 public:
  explicit ShapeTree(const Shape& shape);

  /// Offers to `query` what `ray` (in the shape's space) meets, as a hit of shape 0 that is there in frame 0.
  template <class Query>
  void find(const Ray& ray, Query& query) const;

  /// Boxes of the whole shape or, better, of up to 8 parts of it; with margin, in the shape's space.
  std::vector<Bounds3> outline() const;
  std::size_t memory() const { return triangles_ ? triangles_->memory() : others_.memory(); }

 private:
  const Shape& shape_;
  std::optional<TriangleTree> triangles_;
  Bvh others_;  // over the primitives of a shape that is no mesh
};

}  // namespace dspm
