// --index: a table of all images and what each shows, for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/session/job/job.h"

namespace dspm {

struct IndexedImage {
  FileFrame frame;
  std::vector<std::filesystem::path> files;  // the image, and perhaps a PNG
  std::filesystem::path denoised = {};       // its second image; empty: none
};

/// Returns the table as CSV or as JSON, by the extension of `file`; images are named as seen from its directory.
std::string image_index(const std::filesystem::path& file, const Job& job, const std::vector<IndexedImage>& images);

}  // namespace dspm
