#include "dspm/media/sparse_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dspm {
namespace {

constexpr std::int64_t kMostBlocks = std::int64_t{1} << 28;
constexpr std::int64_t kFewVoxels = 1 << 9;  // are looked at one by one

}  // namespace

SparseGrid::SparseGrid(const Index& low, const Index& high, const Transform& to_medium)
    : low_(low), to_medium_(to_medium) {
  std::int64_t all = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t count = (std::int64_t{high[axis]} - low[axis]) / kSide + 1;
    all = count > 0 && all <= kMostBlocks / count ? all * count : kMostBlocks + 1;
    counts_[axis] = static_cast<int>(std::clamp<std::int64_t>(count, 0, kMostBlocks));
  }
  if (all > kMostBlocks) throw std::runtime_error("its grid is too large");
  blocks_.assign(static_cast<std::size_t>(all), kEmpty);
}

void SparseGrid::set_block(const Index& first, const float* values) {
  const std::size_t block =
      block_at((first[0] - low_[0]) / kSide, (first[1] - low_[1]) / kSide, (first[2] - low_[2]) / kSide);
  blocks_[block] = static_cast<std::uint32_t>(largest_.size());
  values_.insert(values_.end(), values, values + kValues);
  largest_.push_back(*std::max_element(values, values + kValues));
}

void SparseGrid::set_blocks(const Index& first, int size, float value) {
  const auto shared = static_cast<std::uint32_t>(largest_.size());
  values_.insert(values_.end(), kValues, value);
  largest_.push_back(value);
  Index begin, end;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    begin[axis] = std::max(0, (first[axis] - low_[axis]) / kSide);
    end[axis] = std::min(counts_[axis], (first[axis] - low_[axis] + size) / kSide);
  }
  for (int x = begin[0]; x < end[0]; ++x)
    for (int y = begin[1]; y < end[1]; ++y)
      for (int z = begin[2]; z < end[2]; ++z) blocks_[block_at(x, y, z)] = shared;
}

float SparseGrid::value(int x, int y, int z) const {
  const int i = x - low_[0], j = y - low_[1], k = z - low_[2];
  if (i < 0 || j < 0 || k < 0) return 0;
  if (i / kSide >= counts_[0] || j / kSide >= counts_[1] || k / kSide >= counts_[2]) return 0;
  const std::uint32_t block = blocks_[block_at(i / kSide, j / kSide, k / kSide)];
  if (block == kEmpty) return 0;
  const int within = ((i % kSide) * kSide + j % kSide) * kSide + k % kSide;
  return values_[std::size_t{block} * kValues + static_cast<std::size_t>(within)];
}

std::optional<const float*> SparseGrid::within_block(int x, int y, int z) const {
  const int i = x - low_[0], j = y - low_[1], k = z - low_[2];
  if (i < 0 || j < 0 || k < 0) return std::nullopt;
  const auto is_last = [](int n) { return n % kSide == kSide - 1; };
  if (is_last(i) || is_last(j) || is_last(k)) return std::nullopt;
  if (i / kSide >= counts_[0] || j / kSide >= counts_[1] || k / kSide >= counts_[2]) return nullptr;
  const std::uint32_t block = blocks_[block_at(i / kSide, j / kSide, k / kSide)];
  if (block == kEmpty) return nullptr;
  const int first = ((i % kSide) * kSide + j % kSide) * kSide + k % kSide;
  return values_.data() + std::size_t{block} * kValues + static_cast<std::size_t>(first);
}

float SparseGrid::interpolated(const float* first, const Vec3& rest) {
  const auto along_z = [&](const float* v) { return v[0] + rest.z * (v[1] - v[0]); };
  const auto along_y = [&](const float* v) {
    const float near = along_z(v), far = along_z(v + kSide);
    return near + rest.y * (far - near);
  };
  const float near = along_y(first), far = along_y(first + kSide * kSide);
  return near + rest.x * (far - near);
}

float SparseGrid::at(const Vec3& p) const {
  constexpr float kFar = 1e9f;
  const Vec3 voxel = to_medium_.inverse_point(p);
  if (!(std::abs(voxel.x) < kFar && std::abs(voxel.y) < kFar && std::abs(voxel.z) < kFar)) return 0;
  const Vec3 below{std::floor(voxel.x), std::floor(voxel.y), std::floor(voxel.z)}, rest = voxel - below;
  const int x = static_cast<int>(below.x), y = static_cast<int>(below.y), z = static_cast<int>(below.z);
  if (const auto all = within_block(x, y, z)) return *all == nullptr ? 0 : interpolated(*all, rest);
  float sum = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) {
        const float share = (i ? rest.x : 1 - rest.x) * (j ? rest.y : 1 - rest.y) * (k ? rest.z : 1 - rest.z);
        if (share > 0) sum += share * value(x + i, y + j, z + k);
      }
  return sum;
}

float SparseGrid::largest_in(const Bounds3& box) const {
  const Bounds3 voxels = to_medium_.inverse_bounds(box);
  Index first, last;  // voxels that count: one further on each side, for what lies in between and for rounding
  std::int64_t all = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const float most = static_cast<float>(counts_[a]) * kSide, low = static_cast<float>(low_[a]);
    first[a] = static_cast<int>(std::clamp(std::floor(voxels.low[axis] - low - 0.01f), 0.f, most));
    last[a] = static_cast<int>(std::clamp(std::ceil(voxels.high[axis] - low + 0.01f), -1.f, most - 1));
    all *= std::max(0, last[a] - first[a] + 1);
  }
  const int step = all <= kFewVoxels ? 1 : kSide;
  float largest = 0;
  for (int x = first[0] / step; x <= last[0] / step; ++x)
    for (int y = first[1] / step; y <= last[1] / step; ++y)
      for (int z = first[2] / step; z <= last[2] / step; ++z)
        largest =
            std::max(largest, step == 1 ? value(low_[0] + x, low_[1] + y, low_[2] + z) : largest_of_block(x, y, z));
  return largest;
}

float SparseGrid::largest_of_block(int x, int y, int z) const {
  const std::uint32_t block = blocks_[block_at(x, y, z)];
  return block == kEmpty ? 0 : largest_[block];
}

Bounds3 SparseGrid::extent() const {
  Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    low[axis] = static_cast<float>(low_[a] - 1);
    high[axis] = static_cast<float>(low_[a]) + static_cast<float>(counts_[a]) * kSide;
  }
  return to_medium_.bounds({low, high});
}

}  // namespace dspm
