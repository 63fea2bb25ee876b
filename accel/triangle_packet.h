// Four triangles side by side, of which a leaf holds up to two packets. four_triangles.h tests a ray against them.
#pragma once

#include <bit>

#include "dspm/accel/bvh.h"
#include "dspm/accel/four_triangles.h"
#include "dspm/accel/hits.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"

namespace dspm {

struct alignas(16) TrianglePacket {
  static constexpr int kSize = 4;

  FourTriangles::Vertices vertex;
  int shape[kSize] = {-1, -1, -1, -1};
  int primitive[kSize];

  void set(std::size_t lane, int to_shape, int number, const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    const Vec3 corners[3] = {p0, p1, p2};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) vertex[corner][axis][lane] = corners[corner][axis];
    shape[lane] = to_shape;
    primitive[lane] = number;
  }

  /// Offers the ray's hits to `query`; `frames_of(shape)` are the frames in which a triangle exists.
  template <class Query, class FramesOf>
  void find(const FourRays& ray, Query& query, const FramesOf& frames_of) const {
    const FourTriangles four(ray, vertex);
    unsigned wanted = 0;
    FrameSet frames[kSize];
    for (unsigned rest = four.candidates(query.limit()) & lanes(); rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
      frames[lane] = frames_of(shape[lane]) & query.frames();
      if (!frames[lane].empty()) wanted |= 1u << lane;
    }
    // Most that lie across the ray's line but not in its way are walls beyond the end of a shadow ray.
    if (!Query::kNearestFirst && wanted != 0) wanted = four.entered(ray, wanted, query.limit());
    if (wanted == 0) return;
    const FourHits hits = four.meet(ray, wanted);
    for (unsigned rest = hits.lanes; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
      query.offer({hits.t[lane], shape[lane], primitive[lane], {hits.u[lane], hits.v[lane]}}, frames[lane]);
    }
  }

 private:
  /// Returns bits of the lanes in use.
  unsigned lanes() const {
    const __m128i shapes = _mm_load_si128(reinterpret_cast<const __m128i*>(shape));
    return 15u & ~static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(shapes)));
  }
};

/// The most triangles that a leaf holds.
inline constexpr int kLeafSize = 2 * TrianglePacket::kSize;

}  // namespace dspm
