#include "dspm/output/contact_sheet.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/shrink.h"
#include "dspm/output/bitmap_font.h"
#include "dspm/output/image_name.h"

namespace dspm {

namespace {

std::vector<std::string_view> parts_of(std::string_view label) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0, end = 0; end != label.npos; begin = end + 1) {
    end = label.find('-', begin);
    parts.push_back(label.substr(begin, end - begin));
  }
  return parts;
}

/// Keeps at most so many characters of each part: the first ones of words, the last ones of numbers.
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

/// Shortens all parts of the label, because variations of a product may differ in any of them.
std::string shortened(std::string_view label, std::size_t most) {
  if (label.size() <= most) return std::string(label);
  const std::vector<std::string_view> parts = parts_of(label);
  std::string longest = with_short_parts(parts, 1).substr(0, most);
  for (std::size_t letters = 2; letters < most; ++letters)
    if (std::string longer = with_short_parts(parts, letters); longer.size() <= most) longest = std::move(longer);
  return longest;
}

}  // namespace

ContactSheet::ContactSheet(const SheetLayout& layout) : layout_(layout) {
  Image empty(layout.sheet_width(), layout.sheet_height());
  std::fill(empty.pixels.begin(), empty.pixels.end(), Rgb(0.03f));
  draw_text(empty, kSheetGap, kSheetGap, layout_.style().title, layout_.text_scale + 1, Rgb(0.8f));
  pages_.assign(static_cast<std::size_t>(layout.pages), empty);
}

void ContactSheet::put(int i, const Image& image, std::string_view label) {
  const PixelRect place = layout_.place(i);
  Image& page = pages_[static_cast<std::size_t>(layout_.page(i))];
  const Image small = shrunk(image, place.width(), place.height());
  for (int y = 0; y < small.height; ++y) {
    std::copy_n(&small.at(0, y), small.width, &page.at(place.x0, place.y0 + y));
  }
  if (!layout_.style().labels) return;
  const int advance = kTextAdvance * layout_.text_scale;
  const std::string fitting = shortened(label, static_cast<std::size_t>(std::max(1, place.width() / advance)));
  const int left = place.x0 + (place.width() - advance * static_cast<int>(fitting.size())) / 2;
  draw_text(page, left, place.y1 + kSheetGap / 2, fitting, layout_.text_scale, Rgb(0.6f));
}

void ContactSheet::write(const std::filesystem::path& path, const PngFormat& format) const {
  const std::vector<std::filesystem::path> names = page_names(path, layout_);
  for (std::size_t i = 0; i < names.size(); ++i) write_png(names[i], pages_[i], format);
}

std::vector<std::filesystem::path> page_names(const std::filesystem::path& path, const SheetLayout& layout) {
  if (layout.pages == 1) return {image_name(path, std::nullopt)};
  std::vector<std::filesystem::path> names;
  for (int page = 1; page <= layout.pages; ++page) names.push_back(image_name(path, Moment::numbered(page)));
  return names;
}

}  // namespace dspm
