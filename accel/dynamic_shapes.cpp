#include "dspm/accel/dynamic_shapes.h"

#include <cstddef>

#include "dspm/base/math/frames.h"

namespace dspm {
namespace {

// The maximum average number of copies of a triangle in the trees of single frames.
constexpr std::size_t kMostCopies = 2;

}  // namespace

bool live_too_long(std::span<const PlacedShape> shapes, FrameSet all) {
  std::size_t triangles = 0, copies = 0;
  for (const PlacedShape& shape : shapes) {
    if (shape.in_object_space() || !is_dynamic(shape, all)) continue;
    const auto count = static_cast<std::size_t>(shape.shape->primitive_count());
    triangles += count, copies += count * static_cast<std::size_t>((shape.frames & all).count());
  }
  return copies > kMostCopies * triangles;
}

bool are_stored_alike(const PlacedShape& a, const PlacedShape& b) {
  return a.frames == b.frames && a.moves == b.moves && a.in_object_space() == b.in_object_space() &&
         (a.shape->triangles() == nullptr) == (b.shape->triangles() == nullptr) &&
         a.shape->primitive_count() == b.shape->primitive_count() && (a.cutout == nullptr) == (b.cutout == nullptr);
}

}  // namespace dspm
