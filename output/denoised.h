// A frame's second image, with less noise.
#pragma once

#include <cstddef>
#include <filesystem>

#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/job/choices.h"

namespace dspm {

/// The label of the second image's file, and of the text in its header that names the denoiser.
inline constexpr const char* kDenoised = "denoised";

/// Returns the denoiser's name in messages and headers.
const char* name_of(Denoiser denoiser);

/// Denoises the frame's radiance. Throws WriteError, naming `file`, if another program fails.
Image denoised(Denoiser denoiser, const Image& radiance, const Integrator& integrator, Frame frame,
               const std::filesystem::path& file);

/// Returns how many images it takes for each pixel.
std::size_t images_while_denoising(Denoiser denoiser);

}  // namespace dspm
