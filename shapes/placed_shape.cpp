#include "dspm/shapes/placed_shape.h"

#include <cstring>
#include <type_traits>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/beyond_hole.h"
#include "dspm/shapes/in_world.h"
#include "dspm/shapes/placed_bounds.h"

namespace dspm {
namespace {

bool same_bits(const Transform& a, const Transform& b) {
  static_assert(std::is_trivially_copyable_v<Transform>);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

Bounds3 PlacedShape::bounds(int primitive) const { return bounds_of(*this, shape->bounds(primitive)); }

Bounds3 bounds_of(const PlacedShape& placed, const Bounds3& own) {
  if (!placed.in_object_space() || own.empty()) return own;
  Bounds3 world = placed.to_world.bounds(own);
  const Vec3 reach = max(abs(own.low), abs(own.high));
  const Vec3 error = round_trip_error(placed.to_world, reach, max(abs(world.low), abs(world.high)));
  world.low = world.low - error;
  world.high = world.high + error;
  return world;
}

std::optional<PrimitiveHit> PlacedShape::intersect(int primitive, const Ray& ray) const {
  const Ray own = in_object_space() ? to_world.inverse_ray(ray) : ray;
  const auto met = [&](const Ray& part) { return shape->intersect(primitive, part); };
  std::optional<PrimitiveHit> hit = met(own);
  while (hit && !stops(ray, primitive, hit->uv)) hit = meet_beyond(*shape, primitive, own, *hit, met);
  return hit;
}

SurfacePoint PlacedShape::surface_point(int primitive, Vec2 uv) const {
  return in_world(shape->surface_point(primitive, uv));
}

SurfacePoint PlacedShape::seen(int primitive, Vec2 uv, const Vec3& direction) const {
  return in_world(shape->seen(primitive, uv, in_object_space() ? to_world.inverse_vector(direction) : direction));
}

Strip PlacedShape::strip(int primitive, Vec2 uv, const Vec3& direction) const {
  if (!in_object_space()) return shape->strip(primitive, uv, direction);
  const Strip own = shape->strip(primitive, uv, to_world.inverse_vector(direction));
  return {own.number, to_world.vector(own.along), to_world.vector(own.across)};
}

SurfacePoint PlacedShape::in_world(SurfacePoint s) const {
  if (in_object_space()) move_to_world(s, to_world);
  if (flip_normals) dspm::flip_normals(s);
  return s;
}

AreaSample PlacedShape::sample_area(int primitive, Vec2 u) const {
  const Vec2 uv = shape->sample_area(primitive, u);
  const float scale = in_object_space() ? area_scale(shape->surface_point(primitive, uv).ng) : 1.f;
  return {surface_point(primitive, uv), 1 / (shape->area(primitive) * scale)};
}

float PlacedShape::pdf_a(int primitive, const Vec3& ng) const {
  return 1 / (shape->area(primitive) * area_scale(own_normal(to_world, ng)));
}

bool PlacedShape::stops(const Ray& ray, int primitive, Vec2 uv) const {
  if (cutout == nullptr) return true;
  const SurfacePoint point = surface_point(primitive, uv);
  return dspm::stops(cutout->alpha(point), ray, cutout_key, primitive, uv);
}

std::optional<Vec2> PlacedShape::area_numbers(int primitive, const Vec3& p) const {
  return shape->area_numbers(primitive, in_object_space() ? to_world.inverse_point(p) : p);
}

float PlacedShape::area_scale(const Vec3& n) const { return in_object_space() ? dspm::area_scale(to_world, n) : 1; }

bool are_placed_alike(const PlacedShape& a, const PlacedShape& b) {
  return a.shape == b.shape && same_bits(a.to_world, b.to_world) && a.frames == b.frames &&
         (a.cutout == nullptr) == (b.cutout == nullptr);
}

}  // namespace dspm
