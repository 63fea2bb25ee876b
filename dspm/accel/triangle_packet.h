// The contents of a triangle leaf: up to eight triangles side by side. four_triangles.h tests a ray against four at a
// time.
#pragma once

#include <bit>

#include "dspm/accel/bvh.h"
#include "dspm/accel/four_triangles.h"
#include "dspm/accel/hits.h"
#include "dspm/math/frames.h"
#include "dspm/math/vec.h"

namespace dspm {

struct alignas(64) TrianglePacket {
  static constexpr int kSize = 8;

  float vertex[3][3][kSize];  // by corner, axis, lane
  int shape[kSize];
  int primitive[kSize];
  unsigned lanes = 0;  // bits of the lanes in use

  void add(int to_shape, int number, const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    const auto lane = static_cast<std::size_t>(std::popcount(lanes));
    const Vec3 corners[3] = {p0, p1, p2};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) vertex[corner][axis][lane] = corners[corner][axis];
    shape[lane] = to_shape;
    primitive[lane] = number;
    lanes |= 1u << lane;
  }

  /// Offers the ray's hits to `query`; `frames_of(shape)` are the frames in which a triangle exists.
  template <class Query, class FramesOf>
  void find(const FourRays& ray, Query& query, const FramesOf& frames_of) const {
    for (std::size_t first = 0; first < kSize && lanes >> first != 0; first += 4) {
      const FourTriangles four(ray, &vertex[0][0][first], kSize);
      unsigned wanted = 0;
      FrameSet frames[4];
      for (unsigned rest = four.candidates(query.limit()) & lanes >> first; rest != 0; rest &= rest - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
        frames[lane] = frames_of(shape[first + lane]) & query.frames();
        if (!frames[lane].empty()) wanted |= 1u << lane;
      }
      if (wanted == 0) continue;
      const FourHits hits = four.meet(ray, wanted);
      for (unsigned rest = hits.lanes; rest != 0; rest &= rest - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
        query.offer({hits.t[lane], shape[first + lane], primitive[first + lane], {hits.u[lane], hits.v[lane]}},
                    frames[lane]);
      }
    }
  }
};

}  // namespace dspm
