// A shape at its place in the world, in the frames in which it is there. A different place or geometry is a different
// placed shape, so its number tells what a ray hit, and where, whatever the frame.
#pragma once

#include <cstdint>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/cutout.h"
#include "dspm/shapes/shape.h"

namespace dspm {

/// A point on a placed shape with its density by world area.
struct AreaSample {
  SurfacePoint point;
  float pdf_a;
};

struct PlacedShape {
  const Shape* shape = nullptr;
  Transform to_world;  // identity for static meshes: their vertices are in world space
  FrameSet frames;
  bool flip_normals = false;       // ReverseOrientation
  bool moves = false;              // it may change while the shutter is open
  bool caustics = true;            // false: photons end where it would throw them into a caustic
  int material = -1;               // index into the scene's materials
  int light = -1;                  // index into the scene's lights, if this shape emits
  int object = -1;                 // index into the scene's object names
  const Cutout* cutout = nullptr;  // null: it has no holes
  std::uint64_t cutout_key = 0;    // as that of no other shape of the file; one for all frames

  Bounds3 bounds(int primitive) const;
  /// Returns the nearest hit that stops the ray, which is in the world.
  std::optional<PrimitiveHit> intersect(int primitive, const Ray& ray) const;
  SurfacePoint surface_point(int primitive, Vec2 uv) const;
  /// Returns the surface there, as a ray of that direction sees it.
  SurfacePoint seen(int primitive, Vec2 uv, const Vec3& direction) const;
  /// Returns what a surface that turns shows to a ray of that direction.
  Strip strip(int primitive, Vec2 uv, const Vec3& direction) const;
  AreaSample sample_area(int primitive, Vec2 u) const;
  /// The density of sample_area() at a point of the primitive whose normal, in the world, is ng.
  float pdf_a(int primitive, const Vec3& ng) const;
  /// Returns the numbers for which sample_area() gives that point of the world; nullopt if they are not known.
  std::optional<Vec2> area_numbers(int primitive, const Vec3& p) const;
  /// Returns whether the shape stops a ray, in the world, that meets it there, rather than letting it through a hole.
  /// If alpha lies between 0 and 1, the ray itself decides: the same ray decides alike in every tree, query and frame.
  bool stops(const Ray& ray, int primitive, Vec2 uv) const;
  /// The factor from object to world area at a point whose object-space unit normal is n.
  float area_scale(const Vec3& n) const;

  bool in_object_space() const { return !to_world_is_identity; }
  bool to_world_is_identity = true;  // cached, because every ray asks for it

 private:
  SurfacePoint in_world(SurfacePoint own) const;
};

/// Returns whether both are the same shape at the same place in the same frames, whatever their holes look like.
bool are_placed_alike(const PlacedShape& a, const PlacedShape& b);

}  // namespace dspm
