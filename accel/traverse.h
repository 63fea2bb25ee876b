// The traversal of a Bvh, front to back, for a Query: any class with
//   FrameSet frames() const                           the frames still of interest
//   bool reaches(float entry, FrameSet frames) const  something at distance `entry` or later may matter to one of them
//   float limit() const                               nothing beyond this distance matters (at it, it may)
//   static constexpr bool kOneFrame                   frames() never holds more than one frame, limit() suffices
//   static constexpr bool kNearestFirst               the order matters
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "dspm/accel/box_ray.h"
#include "dspm/accel/bvh.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/simd.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// Box tests of a node's children, four at a time.
class NodeTest {
 public:
  explicit NodeTest(const BoxRay& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool negative = ray.negative[static_cast<std::size_t>(axis)];
      near_[axis] = (2 * axis + (negative ? 1 : 0)) * Bvh::kWidth;
      far_[axis] = (2 * axis + (negative ? 0 : 1)) * Bvh::kWidth;
      near_origin_[axis] = _mm_set1_ps(ray.near_origin[axis]);
      far_origin_[axis] = _mm_set1_ps(ray.far_origin[axis]);
      inverse_[axis] = _mm_set1_ps(ray.inverse[axis]);
    }
    const auto is_nan = [](const Vec3& v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); };
    is_nan_ = is_nan(ray.near_origin) || is_nan(ray.inverse);
  }

  /// A ray with NaN would enter all boxes, including the empty ones of unused children, which lead nowhere.
  bool is_nan() const { return is_nan_; }
  /// Returns bits of the children whose boxes the ray enters within `limit`, and sets the distances at which it enters
  /// them.
  unsigned operator()(const Bvh::Node& node, float limit, float* entry) const {
    return half(node, 0, limit, entry) | half(node, 4, limit, entry) << 4;
  }

 private:
  unsigned half(const Bvh::Node& node, int first, float limit, float* entry) const {
    const float* const planes = node.planes[0] + first;
    // The order of the operands matters: if one is NaN (zero times infinity), min and max return the second.
    __m128 enter = _mm_setzero_ps(), leave = _mm_set1_ps(limit);
    for (int axis = 0; axis < 3; ++axis) {
      const __m128 near = _mm_load_ps(planes + near_[axis]), far = _mm_load_ps(planes + far_[axis]);
      enter = _mm_max_ps(_mm_mul_ps(_mm_sub_ps(near, near_origin_[axis]), inverse_[axis]), enter);
      leave = _mm_min_ps(_mm_mul_ps(_mm_sub_ps(far, far_origin_[axis]), inverse_[axis]), leave);
    }
    _mm_store_ps(entry + first, enter);
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(enter, leave)));
  }

  std::ptrdiff_t near_[3], far_[3];  // offsets of planes in a node
  __m128 near_origin_[3], far_origin_[3], inverse_[3];
  bool is_nan_;
};

/// Returns whether the ray enters one of the root's boxes within `limit`.
inline bool enters_root(const Bvh& bvh, const NodeTest& test, float limit) {
  alignas(16) float entry[Bvh::kWidth];
  return !bvh.nodes.empty() && !test.is_nan() && test(bvh.root_node(), limit, entry) != 0;
}

/// Calls visit(leaf number) for the leaves that matter to `query`, roughly in the order in which the ray enters them.
template <class Query, class Visit>
void traverse(const Bvh& bvh, const NodeTest& test, Query& query, const Visit& visit) {
  // The stack: entry distance, number and, if they matter, frames. Uninitialised arrays, since initialising costs time
  // and reading a struct as a whole after writing it by member would stall.
  constexpr int kMost = (Bvh::kWidth - 1) * Bvh::kMaxDepth + 1;
  float at[kMost];
  std::uint32_t child[kMost];
  std::uint64_t common[Query::kOneFrame ? 1 : kMost];
  const auto put = [&](int place, float entry, std::uint32_t number, std::uint64_t frames) {
    at[place] = entry, child[place] = number;
    if constexpr (!Query::kOneFrame) common[place] = frames;
  };
  const auto frames_at = [&](int place) { return Query::kOneFrame ? 0 : common[place]; };
  if (bvh.nodes.empty() || test.is_nan()) return;
  const bool frames_differ = !bvh.node_frames.empty();
  int size = 1;
  put(0, 0, bvh.root, query.frames().bits());
  while (size > 0) {
    --size;
    if (Query::kOneFrame ? at[size] > query.limit() : !query.reaches(at[size], FrameSet(frames_at(size)))) continue;
    const std::uint32_t top = child[size];
    if (top >= Bvh::kLeaf) {
      visit(top - Bvh::kLeaf);
      continue;
    }
    const Bvh::Node& node = bvh.nodes[top];
    alignas(16) float entry[Bvh::kWidth];
    const int base = size;
    for (unsigned hits = test(node, query.limit(), entry); hits != 0; hits &= hits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(hits));
      FrameSet common_frames = query.frames();
      if (frames_differ) {
        common_frames &= bvh.node_frames[top][i];
        if (common_frames.empty()) continue;
      }
      int place = size++;
      if constexpr (Query::kNearestFirst)
        for (; place > base && at[place - 1] < entry[i]; --place)
          put(place, at[place - 1], child[place - 1], frames_at(place - 1));
      put(place, entry[i], node.child[i], common_frames.bits());
    }
  }
}

}  // namespace dspm
