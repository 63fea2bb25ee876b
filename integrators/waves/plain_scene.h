// A scene as plain values behind pointers, which a device can have: what rays meet, the surfaces there, and how they
// scatter light.
#pragma once

#include <cstddef>

#include "dspm/accel/plain_query.h"
#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/plain_material.h"
#include "dspm/shapes/in_world.h"
#include "dspm/shapes/mesh_view.h"
#include "dspm/shapes/plain_shape.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// A shape at its place in the world: a mesh, or a shape of one primitive.
struct PlainPlacedShape {
  MeshView mesh;  // without vertices: it is `shape`
  PlainShape shape;
  Transform to_world;
  bool in_object_space = false, flips_normals = false;
  bool caustics = true;  // see PlacedShape
  bool emits = false, catches_shadows = false;
  int material = 0;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    mesh.each_array(fn);
  }

  /// Returns what PlacedShape::surface_point() returns.
  constexpr SurfaceGeometry surface_point(int primitive, Vec2 uv) const {
    SurfaceGeometry point = mesh.vertices != nullptr ? mesh.surface_point(primitive, uv) : shape.surface_point(uv);
    if (in_object_space) move_to_world(point, to_world);
    if (flips_normals) flip_normals(point);
    return point;
  }
};

struct PlainScene {
  PlainQuery query;
  const PlainPlacedShape* shapes = nullptr;
  const PlainMaterial* materials = nullptr;
  std::size_t shape_count = 0, material_count = 0;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    query.each_array(fn);
    fn(shapes, shape_count);
    fn(materials, material_count);
  }

  constexpr const PlainPlacedShape& shape_of(const RayHit& hit) const { return shapes[hit.shape]; }
};

}  // namespace dspm
