// All images of a scene on a sheet of one page or several, each with a label under it.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "dspm/output/sheet_layout.h"

namespace dspm {

class ContactSheet {
 public:
  explicit ContactSheet(const SheetLayout& layout);
  /// Puts an image, which is as a view shows it, and brings it to the size of its place.
  void put(int i, const Image& image, std::string_view label);
  const Image& image(int page = 0) const { return pages_[static_cast<std::size_t>(page)]; }
  /// To the files that page_names() tells. Throws WriteError.
  void write(const std::filesystem::path& path, const PngFormat& format) const;

 private:
  SheetLayout layout_;
  std::vector<Image> pages_;
};

/// sheet.png or, of several pages, sheet.0001.png and so on.
std::vector<std::filesystem::path> page_names(const std::filesystem::path& path, const SheetLayout& layout);

}  // namespace dspm
