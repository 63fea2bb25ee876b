#include "dspm/media/grid_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace dspm {
namespace {

void expect_sound(const GridPart& part) {
  constexpr int kFarthest = 1 << 29;
  for (const int i : part.first)
    if (std::abs(i) > kFarthest) throw std::runtime_error("it is damaged");
  const auto is_sound = [](float v) { return std::isfinite(v) && v >= 0; };
  if (part.values == nullptr ? !is_sound(part.value)
                             : !std::all_of(part.values, part.values + SparseGrid::kValues, is_sound))
    throw std::runtime_error("some of its values are negative or not finite");
}

}  // namespace

SparseGrid grid_of(std::span<const GridPart> parts, const Transform& to_medium) {
  SparseGrid::Index low{}, high{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    expect_sound(parts[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int first = parts[i].first[axis], last = first + parts[i].size - SparseGrid::kSide;
      low[axis] = i == 0 ? first : std::min(low[axis], first);
      high[axis] = i == 0 ? last : std::max(high[axis], last);
    }
  }
  SparseGrid sparse(low, high, to_medium);
  for (const GridPart& part : parts)
    if (part.values != nullptr)
      sparse.set_block(part.first, part.values);
    else
      sparse.set_blocks(part.first, part.size, part.value);
  return sparse;
}

}  // namespace dspm
