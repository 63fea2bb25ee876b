#include "dspm/media/grid_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace dspm {
namespace {

bool is_sound(float n) { return n >= 0 && std::isfinite(n); }
bool is_sound(const Rgb& c) { return is_sound(c.r) && is_sound(c.g) && is_sound(c.b); }

template <class T>
Voxels<T> checked_grid(ParamReader& reader, std::string_view name, std::vector<T> values,
                       const std::optional<std::array<int, 3>>& counts) {
  if (values.empty() || !counts) return {};
  const auto [x, y, z] = *counts;
  if (const std::int64_t wanted = std::int64_t{x} * y * z; static_cast<std::int64_t>(values.size()) != wanted) {
    reader.error(name, fmt::format("\"{}\" has {} values, but a grid of {} x {} x {} takes {}", name, values.size(), x,
                                   y, z, wanted));
    return {};
  }
  if (!std::all_of(values.begin(), values.end(), [](const T& value) { return is_sound(value); })) {
    reader.error(name, fmt::format("\"{}\" of {} must not be negative", name, reader.subject()));
    return {};
  }
  return {*counts, std::move(values)};
}

}  // namespace

std::optional<std::array<int, 3>> read_counts(ParamReader& reader) {
  constexpr int kMost = 4096;
  std::array<int, 3> counts{};
  bool usable = true;
  const char* const names[] = {"nx", "ny", "nz"};
  for (std::size_t i = 0; i < 3; ++i) {
    counts[i] = reader.integer(names[i], 1, "", "number of voxels along that axis");
    if (counts[i] >= 1 && counts[i] <= kMost) continue;
    reader.error(names[i], fmt::format("\"{}\" must lie between 1 and {}", names[i], kMost));
    usable = false;
  }
  return usable ? std::optional(counts) : std::nullopt;
}

Voxels<float> grid_of(ParamReader& reader, std::string_view name, std::vector<float> numbers,
                      const std::optional<std::array<int, 3>>& counts) {
  return checked_grid(reader, name, std::move(numbers), counts);
}
Voxels<Rgb> grid_of(ParamReader& reader, std::string_view name, std::vector<Rgb> colours,
                    const std::optional<std::array<int, 3>>& counts) {
  return checked_grid(reader, name, std::move(colours), counts);
}

}  // namespace dspm
