// All images of a scene on one sheet, each with a label under it.
#pragma once

#include <string_view>

#include "dspm/film/pixel_rect.h"
#include "dspm/image/image.h"

namespace dspm {

/// A grid shaped roughly like a screen; images are shrunk until a row fits, never enlarged.
struct SheetLayout {
  int columns = 1, rows = 1;
  int image_width = 1, image_height = 1;  // as they appear on the sheet
  int text_scale = 1;

  /// For `count` images of width x height pixels; the sheet is at most `max_width` wide if that is possible at all.
  SheetLayout(int count, int width, int height, int max_width = 2048);
  /// With exactly these columns and rows.
  static SheetLayout table(int columns, int rows, int width, int height, int max_width = 2048);
  int sheet_width() const;
  int sheet_height() const;
  /// Where image i lies, counted row by row from 0; the label is below it.
  PixelRect place(int i) const;

 private:
  SheetLayout() = default;
  void fit(int width, int height, int max_width);
};

class ContactSheet {
 public:
  explicit ContactSheet(const SheetLayout& layout);
  /// `image` has been tone mapped and is shrunk to its place.
  void put(int i, const Image& image, std::string_view label);
  const Image& image() const { return sheet_; }

 private:
  SheetLayout layout_;
  Image sheet_;
};

}  // namespace dspm
