// Terminals that show images: by kitty's graphics protocol, or as sixels.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

enum class Graphics { none, kitty, sixel };

/// Returns what a terminal's answers to graphics_query say. [kitty's protocol:
/// sw.kovidgoyal.net/kitty/graphics-protocol; device attributes: DEC VT340, 4 is sixel]
Graphics graphics_of_answer(std::string_view answer);
/// Asks whether images are known, then for the device's attributes, which every terminal answers. The cursor is at the
/// start of an empty line, which is erased in between: urxvt and others print the first question. `term`, of $TERM, is
/// the terminal's kind: tmux and screen, which do not know kitty's images, would take that question for a title.
std::string_view graphics_query(std::string_view term);

struct TerminalGraphics {
  Graphics kind = Graphics::none;
  int max_width = std::numeric_limits<int>::max(), max_height = std::numeric_limits<int>::max();  // of an image
};

/// Returns a sixel terminal, after it was asked for the largest image that it takes. xterm shows nothing of one that is
/// wider or higher. [xterm, Control Sequences: XTSMGRAPHICS]
TerminalGraphics sixels_of_answer(std::string_view answer);
inline constexpr std::string_view kSixelsQuery = "\x1b[?2;4;0S\x1b[c";

/// Asks the terminal on `descriptor`; none if it does not answer within a part of a second, or is no terminal.
TerminalGraphics ask_for_graphics(int descriptor, std::string_view term);
/// Asks the terminal that standard error goes to; none if it is no terminal.
TerminalGraphics graphics_of_standard_error();

struct TerminalSize {
  int columns = 80, rows = 24;
  int cell_width = 8, cell_height = 16;  // in pixels
  bool operator==(const TerminalSize&) const = default;
};
TerminalSize size_of_terminal(int descriptor);

/// Returns the image at the cursor, pixel by pixel. The cursor may then be anywhere below it.
std::string kitty_image(const Image& shown);
/// Returns the image in 216 colours with ordered dithering.
std::string sixel_image(const Image& shown);

}  // namespace dspm
