// An image in the terminal that is replaced by better ones, while lines of text go on below it.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "dspm/image/image.h"
#include "dspm/looking/terminal.h"

namespace dspm {

class Preview {
 public:
  Preview(const TerminalGraphics& graphics, const TerminalSize& size) : graphics_(graphics), size_(size) {}

  /// The most pixels that a preview has.
  int width() const { return std::min(size_.columns * size_.cell_width, graphics_.max_width); }
  int height() const { return std::min(rows() * size_.cell_height, graphics_.max_height); }

  /// Adapts to the window's size, which may have changed.
  void fit_into(const TerminalSize& size);
  /// Returns what to print to show it: in the place of the one before if that is still on the screen and has kept its
  /// place, else below. The cursor begins and ends at the start of an empty line.
  std::string show(const Image& shown);
  /// Call this when other text is printed.
  void text_follows(std::string_view text);

 private:
  int rows() const { return size_.rows * 2 / 3; }

  TerminalGraphics graphics_;
  TerminalSize size_;
  int rows_shown_ = 0;  // of the image; 0: none
  int rows_below_ = 0;  // lines since
  int column_ = 0;
};

}  // namespace dspm
