#include "dspm/output/sheet_layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dspm/output/bitmap_font.h"

namespace dspm {
namespace {

constexpr int kGap = kSheetGap;
constexpr double kScreen = 1.6;
constexpr int kMostOnAPage = 150;  // on 2048 pixels, images of 4:3 have 160 each then

int label_height(int text_scale) { return kTextHeight * text_scale + kGap / 2; }

int divided_up(int a, int b) { return (a + b - 1) / b; }

}  // namespace

SheetLayout::SheetLayout(const SheetTable& table, int width, int height, SheetStyle style)
    : table_(table), style_(std::move(style)), aspect_(static_cast<double>(width) / height) {
  set_columns(style_.columns > 0 ? std::min(style_.columns, table_.length) : table_.length);
  const bool stays_whole = table_.rows > 1 && unsuited() < kUnsuited;
  if (style_.columns == 0 && !stays_whole) {
    int best = columns;
    double least = unsuited();
    for (int count = table_.inner; count < table_.length; count += table_.inner) {
      set_columns(count);
      if (unsuited() < least) best = count, least = unsuited();
    }
    set_columns(best);
  }
  const int fitting = std::clamp((style_.max_width - kGap) / columns - kGap, 1, width);
  image_width = style_.tile_width > 0 ? style_.tile_width : fitting;
  image_height = std::max(1, static_cast<int>(std::lround(image_width / aspect_)));
  text_scale = image_width >= 384 ? 2 : 1;
}

void SheetLayout::set_columns(int count) {
  columns = count;
  lines_of_row_ = divided_up(table_.length, columns);
  const int all = table_.rows * lines_of_row_;
  const int most = style_.lines > 0 ? style_.lines : std::max(1, kMostOnAPage / columns);
  lines = std::min(all, most), pages = divided_up(all, lines);
  if (pages == 1 || style_.lines > 0) return;
  int unit = lines_of_row_ > most ? 1 : lines_of_row_;  // what a page does not part
  for (const int rows : table_.together)
    if (rows * lines_of_row_ <= most) unit = std::max(unit, rows * lines_of_row_);
  const int units = divided_up(all, unit);
  pages = divided_up(units, most / unit);
  lines = divided_up(units, pages) * unit;  // pages are alike
  pages = divided_up(all, lines);
}

double SheetLayout::unsuited() const {
  const int all = lines * pages,
            seen = style_.lines > 0 ? all : lines;  // who asks for short pages wants no tall columns
  const double cells = static_cast<double>(columns) * all, images = static_cast<double>(table_.length) * table_.rows;
  return std::abs(std::log(aspect_ * columns / seen / kScreen)) + (cells - images) / cells;
}

int SheetLayout::title_height() const { return style_.title.empty() ? 0 : kTextHeight * (text_scale + 1) + kGap; }

int SheetLayout::sheet_width() const { return kGap + columns * (image_width + kGap); }
int SheetLayout::sheet_height() const {
  const int below = style_.labels ? label_height(text_scale) : 0;
  return title_height() + kGap + lines * (image_height + below + kGap);
}

PixelRect SheetLayout::place(int i) const {
  const int below = style_.labels ? label_height(text_scale) : 0;
  const int x = kGap + i % table_.length % columns * (image_width + kGap);
  const int y = title_height() + kGap + line(i) % lines * (image_height + below + kGap);
  return {x, y, x + image_width, y + image_height};
}

}  // namespace dspm
