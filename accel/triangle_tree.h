// A tree over the triangles of one or many meshes that stand in the same space, each mesh there in its own frames. As
// the meshes of a deforming object lie close together, leaves and nodes hold triangles of several frames.
#pragma once

#include "accel/triangle_packet.h"
#include "accel/walk.h"

namespace dspm {

class TriangleTree {
 public:
  /// Over shapes[i] for all i in `which`: meshes, whose to_world is not looked at.
  TriangleTree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all);

  bool empty() const { return triangles_.packets.empty(); }
  /// Offers to `query` what `ray` (in the meshes' space) meets.
  template <class Query>
  void find(const MeshRay& ray, Query& query) const {
    const auto frames_of = [&](int shape) { return frames_[static_cast<std::size_t>(shape)]; };
    walk(triangles_.bvh, ray.box, query,
         [&](std::uint32_t leaf) { triangles_.packets[leaf].find(ray, query, frames_of); });
  }

  const Bvh& bvh() const { return triangles_.bvh; }
  const std::vector<TrianglePacket>& packets() const { return triangles_.packets; }
  std::size_t memory() const;

 private:
  PackedTriangles triangles_;
  std::vector<FrameSet> frames_;  // by shape
};

}  // namespace dspm
