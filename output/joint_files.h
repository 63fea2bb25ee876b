// What a joint render in memory gives besides its images: the same with less noise, and the files that the program writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/output/output.h"
#include "dspm/session/joint_render.h"

namespace dspm {

/// Radiance with less noise. Throws as JointRender::image does, and UsageError if the scene was not loaded with a
/// denoiser.
Image denoised(const JointRender& render, int frame);

/// Which files to write.
struct ImageFiles {
  std::string outfile;      // as of --outfile
  std::vector<int> frames;  // ascending; empty: all
  std::optional<bool> half;
  OutputSettings settings;
};

/// Writes files with the bits of the program's, and returns their names. Throws UsageError for settings that make no
/// sense, and std::runtime_error if a file cannot be written.
std::vector<std::filesystem::path> write(const JointRender& render, const ImageFiles& files, const Warn& warn);

}  // namespace dspm
