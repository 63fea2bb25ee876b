// Intel's Open Image Denoise, by way of the program oidnDenoise that comes with it.
#pragma once

#include <filesystem>

#include "dspm/image/image.h"

namespace dspm {

/// Returns radiance without its noise; normals and albedos are those of the surfaces that the camera sees first. The
/// program reads and writes PFM files next to `file`, which are removed afterwards. Throws WriteError, naming `file`.
Image denoised_by_oidn(const std::filesystem::path& file, const Image& radiance, const Image& albedo,
                       const Image& normal);

/// Tries the program on a small image. Throws WriteError.
void try_oidn(const std::filesystem::path& file);

}  // namespace dspm
