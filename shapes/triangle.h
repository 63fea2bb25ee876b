// The one triangle test of dspm. Every tree calls it, or a SIMD twin that does the same operations in the same order.
// Watertight: rays that pass through a shared edge or vertex hit at least one of the triangles around it.
// [Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection]
#pragma once

#include <algorithm>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/shape.h"

namespace dspm {

/// A ray prepared for the test: axes permuted so that z is the direction's largest component, and the shear that turns
/// the direction into (0, 0, 1) after scaling by sz.
struct TriangleRay {
  Vec3 origin, direction;
  int kx, ky, kz;
  float sx, sy, sz;

  constexpr explicit TriangleRay(const Ray& ray) : origin(ray.origin), direction(ray.direction) {
    const Vec3 d = abs(ray.direction);
    kz = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
    kx = kz == 2 ? 0 : kz + 1;
    ky = kx == 2 ? 0 : kx + 1;
    sx = ray.direction[kx] / ray.direction[kz];
    sy = ray.direction[ky] / ray.direction[kz];
    sz = 1 / ray.direction[kz];
  }
};

/// Returns twice the triangle's area along its normal, which points to the side from which the vertices run
/// counter-clockwise in a right-handed system. It is in double: even the thinnest triangles keep their plane.
constexpr DoubleVec3 area_vector(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  const DoubleVec3 a = difference(p1, p0), b = difference(p2, p0);
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns whether the ray hits, and sets the hit with t in (0, t_max), finite; uv are the barycentrics of p1 and p2. Both
/// sides are hit.
constexpr bool intersect(const TriangleRay& ray, const Vec3& p0, const Vec3& p1, const Vec3& p2, float t_max,
                         PrimitiveHit& hit) {
  const Vec3 a = p0 - ray.origin, b = p1 - ray.origin, c = p2 - ray.origin;
  const float ax = a[ray.kx] - ray.sx * a[ray.kz], ay = a[ray.ky] - ray.sy * a[ray.kz];
  const float bx = b[ray.kx] - ray.sx * b[ray.kz], by = b[ray.ky] - ray.sy * b[ray.kz];
  const float cx = c[ray.kx] - ray.sx * c[ray.kz], cy = c[ray.ky] - ray.sy * c[ray.kz];

  // If rounding leaves an edge function different from zero, its sign is exact, because rounding is monotonic; in
  // double, the products are exact. So two triangles never disagree about the side of their common edge.
  float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
  if (u == 0 || v == 0 || w == 0) {
    u = static_cast<float>(double{cx} * by - double{cy} * bx);
    v = static_cast<float>(double{ax} * cy - double{ay} * cx);
    w = static_cast<float>(double{bx} * ay - double{by} * ax);
  }
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
  const float determinant = (u + v) + w;
  if (determinant == 0) return false;

  const DoubleVec3 n = area_vector(p0, p1, p2);
  if (!(dot(n, n) > 0)) return false;

  // The edge functions would give the distance as well, but with an error that grows as the projected triangle gets
  // thin: a ray could meet the triangle that it leaves. In double, the side of the plane on which the origin lies is
  // certain. If the ray runs in the plane, rounding may put that distance anywhere; the vertices' distances limit it.
  const float plane_t = static_cast<float>(dot(n, difference(p0, ray.origin)) / dot(n, widen(ray.direction)));
  const float za = ray.sz * a[ray.kz], zb = ray.sz * b[ray.kz], zc = ray.sz * c[ray.kz];
  const float nearest = std::min(za, std::min(zb, zc)), farthest = std::max(za, std::max(zb, zc));
  const float t = std::max(nearest, std::min(plane_t, farthest));  // in this order, NaN becomes `nearest`
  if (!(t > 0 && t < t_max && t < kInfinity)) return false;
  const float scale = 1 / determinant;
  hit = {t, {v * scale, w * scale}};
  return true;
}
constexpr std::optional<PrimitiveHit> intersect(const TriangleRay& ray, const Vec3& p0, const Vec3& p1, const Vec3& p2,
                                                float t_max) {
  PrimitiveHit hit;
  return intersect(ray, p0, p1, p2, t_max, hit) ? std::optional<PrimitiveHit>(hit) : std::nullopt;
}

}  // namespace dspm
