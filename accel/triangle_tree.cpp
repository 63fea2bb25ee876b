#include "accel/triangle_tree.h"

namespace dspm {

TriangleTree::TriangleTree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all)
    : triangles_(shapes, which, all) {
  for (const PlacedShape& placed : shapes) frames_.push_back(placed.frames);
}

std::size_t TriangleTree::memory() const {
  return triangles_.bvh.memory() + triangles_.packets.capacity() * sizeof(TrianglePacket) +
         frames_.capacity() * sizeof(FrameSet);
}

}  // namespace dspm
