// Linear pictures in the simple formats that other renderers write besides OpenEXR.
#pragma once

#include <filesystem>

#include "dspm/image/image.h"

namespace dspm {

/// Writes single floats, little endian. [Debevec, Portable FloatMap]
void write_pfm(const std::filesystem::path& path, const Image& image);
/// Writes Radiance's format, with rows that are not compressed: three mantissas of eight bits with one exponent, so at
/// best 1% exact; negative values become 0. [Ward 1991, Real Pixels]
void write_hdr(const std::filesystem::path& path, const Image& image);

}  // namespace dspm
