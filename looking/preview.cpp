#include "dspm/looking/preview.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/image/image.h"
#include "dspm/image/shrink.h"

namespace dspm {
namespace {

constexpr const char* kSaveCursor =
    "\x1b"
    "7";
constexpr const char* kRestoreCursor =
    "\x1b"
    "8";

Image shrunk_to_fit(const Image& image, int width, int height) {
  const double share =
      std::min({1., static_cast<double>(width) / image.width, static_cast<double>(height) / image.height});
  if (share == 1) return image;
  return shrunk(image, std::max(1, static_cast<int>(image.width * share)),
                std::max(1, static_cast<int>(image.height * share)));
}

}  // namespace

void Preview::fit_into(const TerminalSize& size) {
  if (size != size_) rows_shown_ = 0;  // terminals break lines anew
  size_ = size;
}

std::string Preview::show(const Image& shown) {
  const Image image = shrunk_to_fit(shown, width(), height());
  const int rows = (image.height + size_.cell_height - 1) / size_.cell_height;
  const bool in_place = rows_shown_ == rows && rows + rows_below_ < size_.rows;
  std::string text;
  if (!in_place) {
    text.assign(static_cast<std::size_t>(rows), '\n');  // makes room, which may scroll
    rows_below_ = 0, rows_shown_ = rows;
  }
  const int up = rows + rows_below_;
  text += fmt::format("\r\x1b[{}A{}", up, kSaveCursor);
  text += graphics_.kind == Graphics::kitty ? kitty_image(image) : sixel_image(image);
  return text + fmt::format("{}\x1b[{}B\r", kRestoreCursor, up);
}

void Preview::text_follows(std::string_view text) {
  for (const char letter : text) {
    if ((letter & 0xc0) == 0x80) continue;  // a letter's further bytes in UTF-8
    const bool wraps = letter != '\n' && letter != '\r' && column_ == size_.columns;
    if (letter == '\n' || wraps) ++rows_below_;
    column_ = letter == '\n' || letter == '\r' ? 0 : wraps ? 1 : column_ + 1;
  }
}

}  // namespace dspm
