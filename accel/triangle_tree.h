// A tree over the triangles of one or many meshes that stand in the same space, each mesh there in its own frames. As
// the meshes of a deforming object lie close together, leaves and nodes hold triangles of several frames.
#pragma once

#include "accel/hits.h"
#include "accel/triangle_packet.h"
#include "accel/walk.h"
#include "shapes/triangle_mesh.h"

namespace dspm {

class TriangleTree {
 public:
  /// Over shapes[i] for all i in `which`: meshes, whose to_world is not looked at.
  TriangleTree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all);

  /// Offers to `query` what `ray` (in the meshes' space) meets.
  template <class Query>
  void find(const MeshRay& ray, Query& query) const {
    walk(bvh_, ray.box, query, [&](std::uint32_t leaf) {
      const TrianglePacket& packet = packets_[leaf];
      for (unsigned lanes = packet.candidates(ray.triangle, query.limit()); lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        const FrameSet frames = frames_[static_cast<std::size_t>(packet.shape[lane])] & query.frames();
        if (frames.empty()) continue;
        if (const auto hit = packet.meet(lane, ray))
          query.offer({hit->t, packet.shape[lane], packet.primitive[lane], hit->uv}, frames);
      }
    });
  }

  const Bvh& bvh() const { return bvh_; }
  std::size_t memory() const {
    return bvh_.memory() + packets_.capacity() * sizeof(TrianglePacket) + frames_.capacity() * sizeof(FrameSet);
  }

 private:
  Bvh bvh_;
  std::vector<TrianglePacket> packets_;  // by leaf
  std::vector<FrameSet> frames_;         // by shape
};

}  // namespace dspm
