// The contact sheet of a run, and its file: a PNG (or one for each page) with all images, or an animation with one for each row of the table,
// which runs through the row's images.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "dspm/output/contact_sheet.h"
#include "dspm/output/sheet_places.h"
#include "dspm/session/job/job.h"

namespace dspm {

/// The formats of a sheet's file, in words.
inline constexpr std::string_view kSheetNames = ".png, or moves as .webp or .apng";
bool is_sheet_name(const std::filesystem::path& path);

class SheetFile {
 public:
  SheetFile(std::filesystem::path path, const Job& job, const SheetStyle& style);

  /// The files that write() writes.
  std::vector<std::filesystem::path> names() const;
  /// `shown`: by a view.
  void put(FileFrame frame, const Image& shown);
  /// Throws WriteError.
  void write(const PngFormat& format) const;
  /// The bytes that it holds, or will hold, and that it needs for writing.
  std::size_t bytes() const;

 private:
  SheetLayout layout_of(const SheetStyle& style) const;

  std::filesystem::path path_;
  const Job& job_;
  bool moves_;
  SheetPlaces places_;
  SheetLayout layout_;
  std::vector<ContactSheet> sheets_;  // one, or one for each image of a row
};

}  // namespace dspm
