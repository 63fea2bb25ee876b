// Moving pictures that browsers show without a player: WebP and APNG. They run in a loop.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/image/png.h"

namespace dspm {

/// Frames per second of an animation whose scene or files do not say how many.
inline constexpr float kUsualRate = 24;

/// Returns whether the name ends with .webp or .apng.
bool is_animation_name(const std::filesystem::path& path);

/// Writes images of one size, linear, shown one after the other for `seconds` each. WebP is lossy and sRGB, whatever
/// the format; APNG is exact to the PNG's step. Throws WriteError.
void write_animation(const std::filesystem::path& path, const std::vector<Image>& images, double seconds,
                     const PngFormat& format = {});

/// Returns the bytes of an APNG; see write_animation.
std::string apng_bytes(const std::vector<Image>& images, double seconds, const PngFormat& format = {});
/// Returns the bytes of a WebP; see write_animation. Throws std::runtime_error.
std::string webp_bytes(const std::vector<Image>& images, double seconds);

}  // namespace dspm
