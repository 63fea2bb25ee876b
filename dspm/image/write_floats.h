// Linear pictures in the simple formats that other renderers write besides OpenEXR.
#pragma once

#include <filesystem>

#include "dspm/image/image.h"

namespace dspm {

/// Single floats, little endian. [Debevec, Portable FloatMap]
void write_pfm(const std::filesystem::path& path, const Image& image);
/// Radiance's format, rows not compressed: three mantissas of eight bits with one exponent, so at best 1% exact; what
/// is negative becomes 0. [Ward 1991, Real Pixels]
void write_hdr(const std::filesystem::path& path, const Image& image);

}  // namespace dspm
