// Points in a uniform grid, sorted by cell, for finding all points within a radius. Independent of rendering.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/grid/buffer.h"
#include "dspm/base/grid/grid_cells.h"
#include "dspm/base/grid/points_within.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// Cells of one row (neighbours along x) are contiguous in memory, so a query reads a few contiguous runs.
class PointGrid {
 public:
  /// Points and cells are numbered in 32 bits; places beyond the last point need a few of these numbers.
  static constexpr std::size_t kMostPoints = 0xffff'ff00;
  static constexpr std::size_t most_cells(std::size_t points) {
    constexpr std::size_t kCellsPerPoint = 8, kLeastCells = 4096;
    return std::clamp(kCellsPerPoint * points, kLeastCells, kMostPoints);
  }

  /// Sorts `points` by cell; points of a cell keep their order. Cells are `cell_size` wide, or wider if that would
  /// make more than a few cells per point. `points` is not kept. Throws std::length_error if there are too many.
  void build(std::span<const Vec3> points, float cell_size);

  /// Place i of the sorted order holds point order()[i].
  std::span<const std::uint32_t> order() const { return order_; }
  std::size_t bytes() const;
  /// Returns the same grid for a device; this must outlive it, and be built no more.
  PlainGrid plain() const {
    static_assert(PlainGrid::kPadding <= PointsWithin::kPadding);
    return {cells_, begin_.data(), x_.data(), y_.data(), z_.data(), begin_.size() - 1, order_.size()};
  }

  /// Calls fn(i, distance squared) for every place i of the sorted order whose squared distance from p, as computed
  /// here, is at most `radius2`: which points those are depends neither on the cells nor on the other points. Calls
  /// come in ascending order of rows, and of i within a row of cells. Returns the number of points tested.
  template <class Fn>
  std::uint64_t for_each_within(const Vec3& p, float radius2, Fn&& fn) const;

 private:
  // Cells are sorted in two steps, both parallel: consecutive cells form a bucket.
  static constexpr int kBucketBits = 8;
  static constexpr std::size_t kBuckets = 1 << kBucketBits;
  using BucketBegins = std::array<std::uint32_t, kBuckets + 1>;
  struct Sorted {
    std::uint32_t cell, number;  // of a point
  };
  void choose_cells(std::span<const Vec3> points, float cell_size);
  BucketBegins sort_into_buckets(std::span<const Vec3> points);
  void sort_bucket(std::size_t bucket, std::uint32_t begin, std::uint32_t end);

  GridCells cells_;
  Buffer<std::uint32_t> begin_;  // of each cell in the sorted order, and one past the last
  int bucket_shift_ = 0;
  Buffer<Sorted> by_bucket_;
  Buffer<std::uint32_t> order_;
  Buffer<float> x_, y_, z_;  // of the sorted points, plus PointsWithin::kPadding more
};

template <class Fn>
std::uint64_t PointGrid::for_each_within(const Vec3& p, float radius2, Fn&& fn) const {
  if (order_.empty()) return 0;
  std::uint64_t tested = 0;
  PointsWithin found(p, radius2);
  cells_.for_each_row(begin_.data(), p, radius2, [&](std::uint32_t begin, std::uint32_t end) {
    tested += end - begin;
    for (std::uint32_t i = begin; i < end;) {
      i = found.add(x_.data(), y_.data(), z_.data(), i, end);
      if (found.full()) found.empty_into(fn);
    }
  });
  found.empty_into(fn);
  return tested;
}

}  // namespace dspm
