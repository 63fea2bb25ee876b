#include "dspm/output/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/image/shrink.h"
#include "dspm/output/bitmap_font.h"

namespace dspm {

namespace {

constexpr int kGap = 8;  // pixels around images and labels

std::vector<std::string_view> parts_of(std::string_view label) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0, end = 0; end != label.npos; begin = end + 1) {
    end = label.find('-', begin);
    parts.push_back(label.substr(begin, end - begin));
  }
  return parts;
}

/// Of each part so many characters at most: the first ones of words, the last ones of numbers.
std::string with_short_parts(const std::vector<std::string_view>& parts, std::size_t most) {
  std::string label;
  for (const std::string_view part : parts) {
    const bool is_number = part.find_first_not_of("0123456789") == part.npos;
    const std::size_t begin = is_number && part.size() > most ? part.size() - most : 0;
    if (!label.empty()) label += '-';
    label += part.substr(begin, most);
  }
  return label;
}

/// Variations of a product may differ in any part of their names, so all parts get shorter.
std::string shortened(std::string_view label, std::size_t most) {
  if (label.size() <= most) return std::string(label);
  const std::vector<std::string_view> parts = parts_of(label);
  std::string longest = with_short_parts(parts, 1).substr(0, most);
  for (std::size_t letters = 2; letters < most; ++letters)
    if (std::string longer = with_short_parts(parts, letters); longer.size() <= most) longest = std::move(longer);
  return longest;
}

int label_height(int text_scale) { return kTextHeight * text_scale + kGap / 2; }

/// Smaller is better: how far the shape is from 16:10, and how many cells stay empty.
double badness(int count, int columns, double image_aspect) {
  const int rows = (count + columns - 1) / columns;
  const double aspect = image_aspect * columns / rows;
  return std::abs(std::log(aspect / 1.6)) + static_cast<double>(columns * rows - count) / (columns * rows);
}

}  // namespace

SheetLayout::SheetLayout(int count, int width, int height, SheetStyle style) : style_(std::move(style)) {
  const double aspect = static_cast<double>(width) / height;
  for (int c = 2; c <= count; ++c) {
    if (badness(count, c, aspect) < badness(count, columns, aspect)) columns = c;
  }
  rows = (count + columns - 1) / columns;
  fit(width, height);
}

SheetLayout SheetLayout::table(int columns, int rows, int width, int height, SheetStyle style) {
  SheetLayout layout;
  layout.style_ = std::move(style);
  layout.columns = columns, layout.rows = rows;
  layout.fit(width, height);
  return layout;
}

void SheetLayout::fit(int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  const int fitting = std::clamp((style_.max_width - kGap) / columns - kGap, 1, width);
  image_width = style_.tile_width > 0 ? style_.tile_width : fitting;
  image_height = std::max(1, static_cast<int>(std::lround(image_width / aspect)));
  text_scale = image_width >= 384 ? 2 : 1;
}

int SheetLayout::title_height() const { return style_.title.empty() ? 0 : kTextHeight * (text_scale + 1) + kGap; }

int SheetLayout::sheet_width() const { return kGap + columns * (image_width + kGap); }
int SheetLayout::sheet_height() const {
  const int below = style_.labels ? label_height(text_scale) : 0;
  return title_height() + kGap + rows * (image_height + below + kGap);
}

PixelRect SheetLayout::place(int i) const {
  const int below = style_.labels ? label_height(text_scale) : 0;
  const int x = kGap + i % columns * (image_width + kGap);
  const int y = title_height() + kGap + i / columns * (image_height + below + kGap);
  return {x, y, x + image_width, y + image_height};
}

ContactSheet::ContactSheet(const SheetLayout& layout)
    : layout_(layout), sheet_(layout.sheet_width(), layout.sheet_height()) {
  std::fill(sheet_.pixels.begin(), sheet_.pixels.end(), Rgb(0.03f));
  draw_text(sheet_, kGap, kGap, layout_.style().title, layout_.text_scale + 1, Rgb(0.8f));
}

void ContactSheet::put(int i, const Image& image, std::string_view label) {
  const PixelRect place = layout_.place(i);
  const Image small = shrunk(image, place.width(), place.height());
  for (int y = 0; y < small.height; ++y) {
    std::copy_n(&small.at(0, y), small.width, &sheet_.at(place.x0, place.y0 + y));
  }
  if (!layout_.style().labels) return;
  const int advance = kTextAdvance * layout_.text_scale;
  const std::string fitting = shortened(label, static_cast<std::size_t>(std::max(1, place.width() / advance)));
  const int left = place.x0 + (place.width() - advance * static_cast<int>(fitting.size())) / 2;
  draw_text(sheet_, left, place.y1 + kGap / 2, fitting, layout_.text_scale, Rgb(0.6f));
}

}  // namespace dspm
