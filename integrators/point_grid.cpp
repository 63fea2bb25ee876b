#include "integrators/point_grid.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "integrators/refit.h"

namespace dspm {
namespace {

constexpr std::int64_t kGrain = 1 << 14;
constexpr double kCellsPerPoint = 8, kLeastCells = 4096;

int cells_along(float extent, float cell) { return std::max(1, static_cast<int>(std::floor(extent / cell)) + 1); }

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

PointGrid::Cell PointGrid::cell_of(const Vec3& p) const {
  const Vec3 c = (p - bounds_.low) * inverse_cell_;
  const auto clamped = [](float v, int n) { return static_cast<int>(std::clamp(v, 0.f, static_cast<float>(n - 1))); };
  return {clamped(c.x, nx_), clamped(c.y, ny_), clamped(c.z, nz_)};
}

void PointGrid::build(std::span<const Vec3> points, float cell_size) {
  bounds_ = {};
  for (const Vec3& p : points) bounds_.add(p);
  const auto count = static_cast<std::int64_t>(points.size());
  refit(order_, points.size()), refit(cell_, points.size());
  for (auto* coordinates : {&x_, &y_, &z_}) refit(*coordinates, points.size() + kLanes - 1);
  if (points.empty()) return;

  const Vec3 extent = bounds_.extent();
  const float cell =
      affordable_cell(extent, cell_size, std::max(kLeastCells, kCellsPerPoint * static_cast<double>(count)));
  inverse_cell_ = 1 / cell;
  nx_ = cells_along(extent.x, cell), ny_ = cells_along(extent.y, cell), nz_ = cells_along(extent.z, cell);

  parallel_for(count, kGrain, [&](std::int64_t i) {
    const Cell c = cell_of(points[static_cast<std::size_t>(i)]);
    cell_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(index_of(c.x, c.y, c.z));
  });
  begin_.clear();
  refit(begin_, index_of(nx_ - 1, ny_ - 1, nz_ - 1) + 2);
  // Counting sort: begin_[c + 1] first counts cell c, then walks from its begin to its end while points are placed.
  for (const std::uint32_t c : cell_) ++begin_[c + 1];
  std::uint32_t sum = 0;
  for (std::uint32_t& b : begin_) sum += b, b = sum;
  for (std::size_t c = begin_.size() - 1; c > 0; --c) begin_[c] = begin_[c - 1];
  begin_[0] = 0;
  for (std::size_t i = 0; i < points.size(); ++i) order_[begin_[cell_[i] + 1]++] = static_cast<std::uint32_t>(i);
  parallel_for(count, kGrain, [&](std::int64_t i) {
    const auto place = static_cast<std::size_t>(i);
    const Vec3& p = points[order_[place]];
    x_[place] = p.x, y_[place] = p.y, z_[place] = p.z;
  });
}

std::size_t PointGrid::bytes() const {
  return (begin_.capacity() + order_.capacity() + cell_.capacity()) * sizeof(std::uint32_t) +
         (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(float);
}

}  // namespace dspm
