// The files in page/, as the build makes them part of the program.
#pragma once

#include <span>
#include <string_view>

namespace dspm {

struct PageFile {
  std::string_view name, text;
};

std::span<const PageFile> page_files();

}  // namespace dspm
