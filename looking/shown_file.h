// Image files as a screen shows them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/output/view.h"

namespace dspm {

/// Returns whether a name on the command line means an image and no scene: one of the formats that read_image reads.
bool names_an_image(const std::string& name);

/// Reads a file as a screen shows it. OpenEXR, HDR and PFM hold radiance, which goes through the view; what others hold
/// has been through one. Throws std::runtime_error.
Image shown_file(const std::filesystem::path& path, const View& view);
/// An OpenEXR file as a PNG, which is transparent if the render was. Throws std::runtime_error.
void write_shown(const std::filesystem::path& path, const View& view, const std::filesystem::path& png);

/// Returns the files that "a.####.exr" or "a.%04d.exr" stands for, by number; another name is itself. Throws
/// std::runtime_error if there are none.
std::vector<std::string> numbered_files(const std::string& pattern);

}  // namespace dspm
