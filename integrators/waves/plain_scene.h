// A scene as plain values behind pointers, which a device can have: what rays meet, the surfaces there, and how they
// scatter light.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dspm/accel/plain_query.h"
#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/waves/plain_bodies.h"
#include "dspm/materials/plain_material.h"
#include "dspm/materials/refractive_index.h"
#include "dspm/shapes/cutout.h"
#include "dspm/shapes/in_world.h"
#include "dspm/shapes/mesh_view.h"
#include "dspm/shapes/plain_shape.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/world/scene/inside.h"

namespace dspm {

/// A shape at its place in the world: a mesh of triangles, or another shape.
struct PlainPlacedShape {
  MeshView mesh;  // without vertices: it is `shape`
  PlainShape shape;
  Transform to_world;
  bool in_object_space = false, flips_normals = false;
  bool caustics = true;  // see PlacedShape
  bool emits = false, catches_shadows = false;
  int material = 0;
  int body = kNoBody;                          // see Vertex
  const PlainTexture<float>* alpha = nullptr;  // null: it has no holes
  std::uint64_t cutout_key = 0;                // see PlacedShape

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    mesh.each_array(fn);
    shape.each_array(fn);
    fn(alpha, 1);
  }

  /// Returns what PlacedShape::surface_point() returns.
  constexpr SurfaceGeometry surface_point(int primitive, Vec2 uv) const {
    SurfaceGeometry point =
        mesh.vertices != nullptr ? mesh.surface_point(primitive, uv) : shape.surface_point(primitive, uv);
    if (in_object_space) move_to_world(point, to_world);
    if (flips_normals) flip_normals(point);
    return point;
  }

  /// Returns what PlacedShape::stops() returns.
  constexpr bool stops(const Ray& ray, int primitive, Vec2 uv) const {
    return alpha == nullptr || stops_by_alpha(ray, primitive, uv);
  }

 private:
  /// Never inlined: few shapes have holes, and queries ask in several places.
  [[gnu::noinline]] constexpr bool stops_by_alpha(const Ray& ray, int primitive, Vec2 uv) const {
    const SurfaceGeometry point = surface_point(primitive, uv);
    return dspm::stops(alpha->at({point.p, point.uv}), ray, cutout_key, primitive, uv);
  }
};

/// A state of a material that differs between frames.
struct PlainState {
  FrameSet frames;
  std::size_t next = 0;  // the place of the next one among PlainScene::materials; 0: there is none

  friend constexpr bool operator==(const PlainState&, const PlainState&) = default;
};

struct PlainScene {
  PlainQuery query;
  const PlainPlacedShape* shapes = nullptr;
  // By surroundings, then by material, see material_within(). Beyond them are the second states of materials and so on.
  const PlainMaterial* materials = nullptr;
  const PlainState* states = nullptr;  // of the materials, if they have several
  PlainBodies bodies;
  const PlainIndex* surroundings = nullptr;  // the indices of refraction that are around bodies, the usual 1 first
  std::size_t shape_count = 0, material_count = 0, surroundings_count = 0, state_count = 0;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    query.each_array(fn);
    fn(shapes, shape_count);
    fn(materials, state_count), fn(states, state_count);
    bodies.each_array(fn);
    fn(surroundings, surroundings_count);
  }

  constexpr const PlainPlacedShape& shape_of(const RayHit& hit) const { return shapes[hit.shape]; }
  /// Returns whether these frames are not all in one state of a material.
  constexpr bool differs_in(int material, FrameSet frames) const {
    const auto place = static_cast<std::size_t>(material);
    if (states[place] == PlainState() || frames.empty()) return false;
    return !states[place_in(place, frames.lowest())].frames.contains(frames);
  }
  /// Calls fn(FrameSet, const PlainMaterial&) for the states of a material in some of these frames, as it is within that body;
  /// null: within none of another priority.
  template <class Fn>
  constexpr void for_each_state(int material, const PlainBody* around, FrameSet frames, const Fn& fn) const {
    std::size_t place = place_within(material, around);
    if (states[place] == PlainState()) return fn(frames, materials[place]);
    do {
      if (const FrameSet common = states[place].frames & frames; !common.empty()) fn(common, materials[place]);
      place = states[place].next;
    } while (place != 0);
  }
  /// Returns the place of its state in a frame; `first` is that of its first state.
  constexpr std::size_t place_in(std::size_t first, Frame frame) const {
    std::size_t place = first;
    while (states[place].next != 0 && !states[place].frames.contains(frame)) place = states[place].next;
    return place;
  }
  /// Returns the place among `materials` of what a path has met that has arrived in these bodies.
  constexpr std::size_t place_of_material(const RayHit& hit, const Inside& arriving) const {
    const PlainPlacedShape& shape = shape_of(hit);
    return place_within(shape.material, bodies.around(shape.body, arriving));
  }
  /// Returns the index of refraction around it.
  constexpr const PlainIndex& index_around(const RayHit& hit, const Inside& arriving) const {
    return surroundings[place_of_material(hit, arriving) / material_count];
  }

 private:
  constexpr std::size_t place_within(int material, const PlainBody* around) const {
    const std::size_t first = around == nullptr ? 0 : static_cast<std::size_t>(around->surroundings) * material_count;
    return first + static_cast<std::size_t>(material);
  }
};

/// The query of a scene, with the holes of its shapes.
struct PlainSceneQuery {
  const PlainScene& scene;

  constexpr HitPartition partition(const Ray& ray, FrameSet frames) const {
    return scene.query.partition(ray, frames, *this);
  }
  constexpr FrameSet occluded(const Ray& ray, FrameSet frames) const {
    return scene.query.occluded(ray, frames, *this);
  }

  constexpr bool stops(int shape, const Ray& ray, int primitive, Vec2 uv) const {
    return scene.shapes[shape].stops(ray, primitive, uv);
  }
};

}  // namespace dspm
