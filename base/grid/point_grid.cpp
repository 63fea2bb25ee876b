#include "dspm/base/grid/point_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "dspm/base/grid/counting_sort.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

/// Returns the points for one thread at a time: few, so that many threads share small grids.
std::int64_t grain(std::int64_t points) {
  constexpr std::int64_t kLeast = 1 << 10, kMost = 1 << 14, kChunks = 64;
  return std::clamp(points / kChunks, kLeast, kMost);
}

int cells_along(float extent, float cell) { return truncated(extent / cell, 1e6f) + 1; }

/// Widens the cells until there are at most `most` of them.
float affordable_cell(const Vec3& extent, float cell, double most) {
  const float largest = std::max(max_component(extent), 1e-30f);
  cell = std::max(cell, largest * 1e-4f);
  while (static_cast<double>(cells_along(extent.x, cell)) * cells_along(extent.y, cell) * cells_along(extent.z, cell) >
         most)
    cell *= 1.1f;
  return cell;
}

}  // namespace

void PointGrid::build(std::span<const Vec3> points, float cell_size) {
  if (points.size() > kMostPoints)
    throw std::length_error(
        "more than 4.29 billion photons are stored at once; --memory traces an iteration's photons in batches");
  order_.refit(points.size()), by_bucket_.refit(points.size());
  for (Buffer<float>* coordinates : {&x_, &y_, &z_}) {
    coordinates->refit(points.size() + PointsWithin::kPadding);
    std::fill(coordinates->begin() + points.size(), coordinates->end(), 0.f);
  }
  if (points.empty()) return;
  choose_cells(points, cell_size);
  const BucketBegins begins = sort_into_buckets(points);
  parallel_for(kBuckets, 1, [&](std::int64_t bucket) {
    const auto b = static_cast<std::size_t>(bucket);
    sort_bucket(b, begins[b], begins[b + 1]);
    for (std::uint32_t place = begins[b]; place < begins[b + 1]; ++place) {
      const Vec3& p = points[order_[place]];
      x_[place] = p.x, y_[place] = p.y, z_[place] = p.z;
    }
  });
}

void PointGrid::choose_cells(std::span<const Vec3> points, float cell_size) {
  const auto count = static_cast<std::int64_t>(points.size());
  const std::int64_t at_once = grain(count);
  std::vector<Bounds3> bounds(static_cast<std::size_t>(chunk_count(count, at_once)));
  parallel_for(count, at_once, [&](std::int64_t i) {
    bounds[static_cast<std::size_t>(i / at_once)].add(points[static_cast<std::size_t>(i)]);
  });
  cells_.bounds = {};
  for (const Bounds3& b : bounds) cells_.bounds.add(b);

  const Vec3 extent = cells_.bounds.extent();
  const float cell = affordable_cell(extent, cell_size, static_cast<double>(most_cells(points.size())));
  cells_.inverse_cell = 1 / cell;
  cells_.nx = cells_along(extent.x, cell), cells_.ny = cells_along(extent.y, cell);
  cells_.nz = cells_along(extent.z, cell);
  const std::size_t cells = cells_.index_of(cells_.nx - 1, cells_.ny - 1, cells_.nz - 1) + 1;
  begin_.refit(cells + 1);
  begin_.back() = static_cast<std::uint32_t>(count);
  bucket_shift_ = std::max(0, static_cast<int>(std::bit_width(cells - 1)) - kBucketBits);
}

PointGrid::BucketBegins PointGrid::sort_into_buckets(std::span<const Vec3> points) {
  const auto count = static_cast<std::int64_t>(points.size()), at_once = grain(count);
  const auto for_each_point = [&](const auto& fn) {
    parallel_for(count, at_once, [&](std::int64_t i) {
      const GridCells::Cell c = cells_.cell_of(points[static_cast<std::size_t>(i)]);
      const auto cell = static_cast<std::uint32_t>(cells_.index_of(c.x, c.y, c.z));
      fn(static_cast<std::size_t>(i / at_once), cell >> bucket_shift_, Sorted{cell, static_cast<std::uint32_t>(i)});
    });
  };
  // By chunk of points and bucket: the number of points, then the place of the next one.
  std::vector<std::array<std::uint32_t, kBuckets>> places(static_cast<std::size_t>(chunk_count(count, at_once)));
  for_each_point([&](std::size_t chunk, std::uint32_t bucket, Sorted) { ++places[chunk][bucket]; });
  BucketBegins begins;
  turn_into_places(places, begins);
  for_each_point(
      [&](std::size_t chunk, std::uint32_t bucket, Sorted point) { by_bucket_[places[chunk][bucket]++] = point; });
  return begins;
}

void PointGrid::sort_bucket(std::size_t bucket, std::uint32_t begin, std::uint32_t end) {
  const std::size_t cells = begin_.size() - 1, first = std::min(bucket << bucket_shift_, cells),
                    last = std::min((bucket + 1) << bucket_shift_, cells);
  const auto points = std::span<const Sorted>(by_bucket_).subspan(begin, end - begin);
  // Counting sort: begin_[c] first counts the points of cell c, then advances from the cell's begin to its end.
  std::fill_n(begin_.data() + first, last - first, 0u);
  for (const Sorted& point : points) ++begin_[point.cell];
  std::uint32_t sum = begin;
  for (std::size_t c = first; c < last; ++c) sum += std::exchange(begin_[c], sum);
  for (const Sorted& point : points) order_[begin_[point.cell]++] = point.number;
  for (std::size_t c = last; c-- > first + 1;) begin_[c] = begin_[c - 1];
  if (first < last) begin_[first] = begin;
}

std::size_t PointGrid::bytes() const {
  return begin_.bytes() + order_.bytes() + by_bucket_.bytes() + x_.bytes() + y_.bytes() + z_.bytes();
}

}  // namespace dspm
