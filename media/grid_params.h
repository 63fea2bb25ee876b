// The parameters of media on grids.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/media/voxels.h"

namespace dspm {

/// Reads "nx", "ny" and "nz"; nullopt after an error.
std::optional<std::array<int, 3>> read_counts(ParamReader& reader);

/// Makes a grid of the values of the parameter `name`; empty if there are none, or after an error.
Voxels<float> grid_of(ParamReader& reader, std::string_view name, std::vector<float> numbers,
                      const std::optional<std::array<int, 3>>& counts);
Voxels<Rgb> grid_of(ParamReader& reader, std::string_view name, std::vector<Rgb> colours,
                    const std::optional<std::array<int, 3>>& counts);

}  // namespace dspm
