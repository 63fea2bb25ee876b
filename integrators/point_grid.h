// Points in a uniform grid, sorted by cell, for finding all points within a radius. Knows no rendering.
#pragma once

#include <immintrin.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace dspm {

/// Cells of one row (neighbours along x) lie behind one another in memory, so a query walks a few contiguous runs.
class PointGrid {
 public:
  /// Sorts `points` by cell; points of a cell stay in their order. Cells are `cell_size` wide, or wider where that
  /// would make more than a few cells a point. `points` is not kept.
  void build(std::span<const Vec3> points, float cell_size);

  /// Place i of the sorted order holds point order()[i].
  std::span<const std::uint32_t> order() const { return order_; }
  std::size_t bytes() const;

  /// Calls fn(i, distance squared) for every place i of the sorted order whose squared distance from p, as computed
  /// here, is at most `radius2`: which points those are depends neither on the cells nor on the other points. In
  /// ascending order of i within a row of cells and of rows. Returns how many points were tested.
  template <class Fn>
  std::uint64_t for_each_within(const Vec3& p, float radius2, Fn&& fn) const;

 private:
  struct Cell {
    int x, y, z;
  };
  Cell cell_of(const Vec3& p) const;  // clamped into the grid
  std::size_t index_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }

  // Cells are sorted in two steps, of which threads can share both: consecutive cells make a bucket.
  static constexpr int kBucketBits = 8;
  static constexpr std::size_t kBuckets = 1 << kBucketBits;
  using BucketBegins = std::array<std::uint32_t, kBuckets + 1>;
  struct Sorted {
    std::uint32_t cell, number;  // of a point
  };
  void choose_cells(std::span<const Vec3> points, float cell_size);
  BucketBegins sort_into_buckets(std::span<const Vec3> points);
  void sort_bucket(std::size_t bucket, std::uint32_t begin, std::uint32_t end);

  using Lanes = __m128;  // of points, tested together
  static constexpr std::uint32_t kLanes = 4;

  Bounds3 bounds_;
  float inverse_cell_ = 1;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<std::uint32_t> begin_;  // of each cell in the sorted order, and one past the last
  int bucket_shift_ = 0;
  std::vector<Sorted> by_bucket_;
  std::vector<std::uint32_t> order_;
  std::vector<float> x_, y_, z_;  // of the sorted points, and kLanes - 1 more so that the last can be loaded
};

/// For each set of four lanes the byte shuffle that moves them to the front.
struct LaneShuffles {
  alignas(16) std::uint8_t bytes[16][16] = {};

  constexpr LaneShuffles() {
    for (std::size_t set = 0; set < 16; ++set) {
      std::size_t to = 0;
      for (std::size_t lane = 0; lane < 4; ++lane)
        if (set >> lane & 1)
          for (std::size_t byte = 0; byte < 4; ++byte) bytes[set][to++] = static_cast<std::uint8_t>(4 * lane + byte);
    }
  }
};
inline constexpr LaneShuffles kLaneShuffles;

/// Points within the radius, collected without a branch: about one in three is, in no order that a processor could
/// guess.
class FoundPoints {
 public:
  /// Those of the points first .. first + 3 whose bits are set.
  void add(std::uint32_t first, __m128 distance2, unsigned within) {
    const __m128i numbers = _mm_add_epi32(_mm_set1_epi32(static_cast<int>(first)), _mm_setr_epi32(0, 1, 2, 3));
    const __m128i together = _mm_load_si128(reinterpret_cast<const __m128i*>(kLaneShuffles.bytes[within]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(numbers_ + count_), _mm_shuffle_epi8(numbers, together));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(distance2_ + count_),
                     _mm_shuffle_epi8(_mm_castps_si128(distance2), together));
    count_ += static_cast<std::uint32_t>(std::popcount(within));
  }
  bool full() const { return count_ > kRoom - 4; }
  template <class Fn>
  void empty_into(Fn&& fn) {
    for (std::uint32_t k = 0; k < count_; ++k) fn(numbers_[k], distance2_[k]);
    count_ = 0;
  }

 private:
  static constexpr std::uint32_t kRoom = 128;
  std::uint32_t count_ = 0;
  std::uint32_t numbers_[kRoom];
  float distance2_[kRoom];
};

template <class Fn>
std::uint64_t PointGrid::for_each_within(const Vec3& p, float radius2, Fn&& fn) const {
  if (order_.empty()) return 0;
  // Rounded outward, so that no cell is left out whose points the distance test would let pass.
  const float radius = std::sqrt(radius2) * (1 + 0x1p-20f);
  const Vec3 reach = Vec3{radius, radius, radius} + abs(p) * 0x1p-21f, from = p - reach, to = p + reach;
  if (!(to.x >= bounds_.low.x && from.x <= bounds_.high.x && to.y >= bounds_.low.y && from.y <= bounds_.high.y &&
        to.z >= bounds_.low.z && from.z <= bounds_.high.z))
    return 0;
  const Cell low = cell_of(from), high = cell_of(to);
  const Lanes px = _mm_set1_ps(p.x), py = _mm_set1_ps(p.y), pz = _mm_set1_ps(p.z), limit = _mm_set1_ps(radius2);
  const float *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
  std::uint64_t tested = 0;
  FoundPoints found;
  for (int cz = low.z; cz <= high.z; ++cz)
    for (int cy = low.y; cy <= high.y; ++cy) {
      const std::uint32_t begin = begin_[index_of(low.x, cy, cz)], end = begin_[index_of(high.x, cy, cz) + 1];
      tested += end - begin;
      for (std::uint32_t i = begin; i < end; i += kLanes) {
        const Lanes dx = _mm_sub_ps(_mm_loadu_ps(x + i), px), dy = _mm_sub_ps(_mm_loadu_ps(y + i), py),
                    dz = _mm_sub_ps(_mm_loadu_ps(z + i), pz);
        const Lanes d2 = _mm_add_ps(_mm_add_ps(_mm_mul_ps(dx, dx), _mm_mul_ps(dy, dy)), _mm_mul_ps(dz, dz));
        auto within = static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(d2, limit)));
        if (end - i < kLanes) within &= (1u << (end - i)) - 1;
        found.add(i, d2, within);
        if (found.full()) found.empty_into(fn);
      }
    }
  found.empty_into(fn);
  return tested;
}

}  // namespace dspm
