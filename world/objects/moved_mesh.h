// A mesh that stays in one place is moved there once, so that rays meet it in the world's space.
#pragma once

#include <memory>

#include "dspm/base/math/transform.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/world/objects/kept_geometry.h"

namespace dspm {

inline std::shared_ptr<const Shape> moved_to(const Transform& to_world, const std::shared_ptr<const Shape>& mesh,
                                             KeptGeometry* kept) {
  ContentKey what("moved");
  what.add_bytes_of(to_world);
  return derived<TriangleMesh>(kept, {mesh}, what, [&] { return mesh->triangles()->transformed(to_world); });
}

}  // namespace dspm
