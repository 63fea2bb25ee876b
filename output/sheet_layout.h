// Where images lie on contact sheets: in columns that suit the page, on several pages if there are many.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dspm/image/film/pixel_rect.h"

namespace dspm {

/// Pixels around images and labels.
inline constexpr int kSheetGap = 8;

struct SheetStyle {
  int tile_width = 0;      // of the images; 0: theirs, shrunk until a line fits
  int max_width = 2048;    // of the sheet, unless tile_width says otherwise
  bool labels = true;      // under the images
  std::string title = {};  // over all; empty: none
  int columns = 0;         // images in a line; 0: as suits the page
  int lines = 0;           // on a page; 0: as many as can be looked at together
};

/// Rows of so many images. A row that is too long for the page goes on in further lines.
struct SheetTable {
  int length = 1, rows = 1;
  int inner = 1;                   // rows are broken after multiples of so many
  std::vector<int> together = {};  // pages begin after multiples of so many rows: of the largest number that fits
};

/// Pages shaped roughly like a screen. Images are not enlarged unless the style says so.
struct SheetLayout {
  int columns = 1, lines = 1;  // of a page
  int pages = 1;
  int image_width = 1, image_height = 1;  // as they appear on the sheet
  int text_scale = 1;

  /// For images of width x height pixels; a page is at most as wide as the style says if that is possible at all.
  SheetLayout(const SheetTable& table, int width, int height, SheetStyle style = {});
  /// For so many, one after the other.
  SheetLayout(int count, int width, int height, SheetStyle style = {})
      : SheetLayout(SheetTable{.length = count}, width, height, std::move(style)) {}

  int sheet_width() const;
  int sheet_height() const;
  /// Where image i lies on its page, counted row by row from 0; the label is below it.
  PixelRect place(int i) const;
  int page(int i) const { return line(i) / lines; }
  /// How far the page's shape is from that of a screen, as a logarithm, and the share that stays empty.
  double unsuited() const;
  const SheetStyle& style() const { return style_; }

 private:
  void set_columns(int count);
  int line(int i) const { return i / table_.length * lines_of_row_ + i % table_.length / columns; }
  int title_height() const;

  SheetTable table_;
  SheetStyle style_;
  double aspect_;  // of the images
  int lines_of_row_ = 1;
};

/// A page this far from the shape of a screen is worth another arrangement: a factor of three.
inline constexpr double kUnsuited = 1.1;

}  // namespace dspm
