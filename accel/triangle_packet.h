// Up to eight triangles side by side: what a leaf of triangles is. Lanes decide together which of the triangles the
// ray may meet; those few are then tested one by one by the routine that decides (meet.h), so no second version
// of the triangle test exists that could disagree with it.
#pragma once

#include <immintrin.h>

#include "accel/bvh.h"
#include "accel/hits.h"
#include "accel/meet.h"

namespace dspm {

struct alignas(64) TrianglePacket {
  static constexpr int kSize = 8;

  float vertex[3][3][kSize];  // by corner, axis, lane
  int shape[kSize];
  int primitive[kSize];
  unsigned lanes = 0;  // bits of those in use

  void add(int to_shape, int number, const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    const auto lane = static_cast<std::size_t>(std::popcount(lanes));
    const Vec3 corners[3] = {p0, p1, p2};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) vertex[corner][axis][lane] = corners[corner][axis];
    shape[lane] = to_shape;
    primitive[lane] = number;
    lanes |= 1u << lane;
  }
  /// Lanes of the triangles that the ray may meet at a distance in (0, limit]: those whose edge functions (computed as
  /// the triangle test does) have no two opposite signs, and of whose corners not all are behind the ray or too far.
  /// Zero is no sign: there the triangle test looks closer. It keeps distances between those of the corners.
  unsigned candidates(const TriangleRay& ray, float limit) const {
    const unsigned low = lanes & four_candidates(0, ray, limit);
    return lanes < 16 ? low : low | (lanes & four_candidates(4, ray, limit) << 4);
  }
  unsigned four_candidates(int first, const TriangleRay& ray, float limit) const {
    const __m128 sx = _mm_set1_ps(ray.sx), sy = _mm_set1_ps(ray.sy), sz = _mm_set1_ps(ray.sz);
    __m128 x[3], y[3], z[3];
    for (int i = 0; i < 3; ++i) {
      z[i] = _mm_sub_ps(_mm_load_ps(vertex[i][ray.kz] + first), _mm_set1_ps(ray.origin[ray.kz]));
      x[i] = _mm_sub_ps(_mm_load_ps(vertex[i][ray.kx] + first), _mm_set1_ps(ray.origin[ray.kx]));
      y[i] = _mm_sub_ps(_mm_load_ps(vertex[i][ray.ky] + first), _mm_set1_ps(ray.origin[ray.ky]));
      x[i] = _mm_sub_ps(x[i], _mm_mul_ps(sx, z[i]));
      y[i] = _mm_sub_ps(y[i], _mm_mul_ps(sy, z[i]));
      z[i] = _mm_mul_ps(sz, z[i]);
    }
    const __m128 u = _mm_sub_ps(_mm_mul_ps(x[2], y[1]), _mm_mul_ps(y[2], x[1]));
    const __m128 v = _mm_sub_ps(_mm_mul_ps(x[0], y[2]), _mm_mul_ps(y[0], x[2]));
    const __m128 w = _mm_sub_ps(_mm_mul_ps(x[1], y[0]), _mm_mul_ps(y[1], x[0]));
    const auto least = [](const __m128* a) { return _mm_min_ps(_mm_min_ps(a[0], a[1]), a[2]); };
    const auto most = [](const __m128* a) { return _mm_max_ps(_mm_max_ps(a[0], a[1]), a[2]); };
    const __m128 edges[3] = {u, v, w}, zero = _mm_setzero_ps();
    const __m128 outside = _mm_and_ps(_mm_cmplt_ps(least(edges), zero), _mm_cmpgt_ps(most(edges), zero));
    const __m128 apart = _mm_or_ps(_mm_cmple_ps(most(z), zero), _mm_cmpgt_ps(least(z), _mm_set1_ps(limit)));
    return 15u & ~static_cast<unsigned>(_mm_movemask_ps(_mm_or_ps(outside, apart)));
  }

  Vec3 corner(int i, std::size_t lane) const { return {vertex[i][0][lane], vertex[i][1][lane], vertex[i][2][lane]}; }
  std::optional<PrimitiveHit> meet(std::size_t lane, const MeshRay& ray) const {
    return dspm::meet(ray, corner(0, lane), corner(1, lane), corner(2, lane));
  }

  /// Offers to `query` what the ray meets; `frames_of(shape)` are the frames in which a triangle is there.
  template <class Query, class FramesOf>
  void find(const MeshRay& ray, Query& query, const FramesOf& frames_of) const {
    for (unsigned rest = candidates(ray.triangle, query.limit()); rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
      const FrameSet frames = frames_of(shape[lane]) & query.frames();
      if (frames.empty()) continue;
      if (const auto hit = meet(lane, ray)) query.offer({hit->t, shape[lane], primitive[lane], hit->uv}, frames);
    }
  }

  /// With margin.
  Bounds3 bounds() const;
};

/// Numbers of placed shapes: meshes that stand in world space, and everything else.
struct ShapesByKind {
  std::vector<int> meshes, others;
};

/// Those for which wanted(PlacedShape) holds.
template <class Wanted>
ShapesByKind by_kind(std::span<const PlacedShape> shapes, const Wanted& wanted) {
  ShapesByKind kinds;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    if (!wanted(shapes[s])) continue;
    const bool world_mesh = shapes[s].shape->triangles() && !shapes[s].in_object_space();
    (world_mesh ? kinds.meshes : kinds.others).push_back(static_cast<int>(s));
  }
  return kinds;
}

/// The triangles of shapes[i] for all i in `which`, those side by side that are near each other.
struct PackedTriangles {
  std::vector<TrianglePacket> packets;
  Bvh bvh;  // over them

  PackedTriangles(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all);
};

}  // namespace dspm
