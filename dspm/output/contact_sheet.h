// All images of a scene on one sheet, each with a label under it.
#pragma once

#include <string>
#include <string_view>

#include "dspm/film/pixel_rect.h"
#include "dspm/image/image.h"

namespace dspm {

struct SheetStyle {
  int tile_width = 0;      // of the images; 0: theirs, shrunk until a row fits
  int max_width = 2048;    // of the sheet, unless tile_width says otherwise
  bool labels = true;      // under the images
  std::string title = {};  // over all; empty: none
};

/// A grid shaped roughly like a screen. Images are not enlarged unless the style says so.
struct SheetLayout {
  int columns = 1, rows = 1;
  int image_width = 1, image_height = 1;  // as they appear on the sheet
  int text_scale = 1;

  /// For `count` images of width x height pixels; the sheet is at most as wide as the style says if that is possible at
  /// all.
  SheetLayout(int count, int width, int height, SheetStyle style = {});
  /// With exactly these columns and rows.
  static SheetLayout table(int columns, int rows, int width, int height, SheetStyle style = {});
  int sheet_width() const;
  int sheet_height() const;
  /// Where image i lies, counted row by row from 0; the label is below it.
  PixelRect place(int i) const;
  const SheetStyle& style() const { return style_; }

 private:
  SheetLayout() = default;
  void fit(int width, int height);
  int title_height() const;

  SheetStyle style_;
};

class ContactSheet {
 public:
  explicit ContactSheet(const SheetLayout& layout);
  /// `image` is as a view shows it, and is brought to the size of its place.
  void put(int i, const Image& image, std::string_view label);
  const Image& image() const { return sheet_; }

 private:
  SheetLayout layout_;
  Image sheet_;
};

}  // namespace dspm
