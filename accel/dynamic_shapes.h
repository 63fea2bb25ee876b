// Which shapes differ between the frames that are rendered together, or move while their shutter is open.
#pragma once

#include <span>

#include "dspm/base/math/frames.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

inline bool is_static(const PlacedShape& shape, FrameSet all) { return shape.frames.contains(all) && !shape.moves; }
inline bool is_dynamic(const PlacedShape& shape, FrameSet all) {
  return !is_static(shape, all) && !(shape.frames & all).empty();
}

/// Returns whether trees of single frames over what is dynamic would hold too many copies of triangles in world space.
bool live_too_long(std::span<const PlacedShape> shapes, FrameSet all);

/// Returns whether a tree holds both in the same way: they differ in places and vertices only.
bool are_stored_alike(const PlacedShape& a, const PlacedShape& b);

}  // namespace dspm
