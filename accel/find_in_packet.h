// A ray against a packet of triangles, side by side.
#pragma once

#include <bit>

#include "dspm/accel/four_triangles.h"
#include "dspm/accel/triangle_packet.h"
#include "dspm/base/math/frames.h"

namespace dspm {

/// Offers the ray's hits to `query`; `frames_of(shape)` are the frames in which a triangle exists.
template <class Query, class FramesOf>
void find_in(const TrianglePacket& packet, const FourRays& ray, Query& query, const FramesOf& frames_of) {
  const FourTriangles four(ray, packet.vertex);
  const __m128i shapes = _mm_load_si128(reinterpret_cast<const __m128i*>(packet.shape));
  const unsigned unused = static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(shapes)));
  unsigned wanted = 0;
  FrameSet frames[TrianglePacket::kSize];
  for (unsigned rest = four.candidates(query.limit()) & ~unused; rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
    frames[lane] = frames_of(packet.shape[lane]) & query.frames();
    if (!frames[lane].empty()) wanted |= 1u << lane;
  }
  // Most that lie across the ray's line but not in its way are walls beyond the end of a shadow ray.
  if (!Query::kNearestFirst && wanted != 0) wanted = four.entered(ray, wanted, query.limit());
  if (wanted == 0) return;
  const FourHits hits = four.meet(ray, wanted);
  for (unsigned rest = hits.lanes; rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
    query.offer({hits.t[lane], packet.shape[lane], packet.primitive[lane], {hits.u[lane], hits.v[lane]}}, frames[lane]);
  }
}

}  // namespace dspm
