// Terminals that show images: by kitty's graphics protocol, or as sixels.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dspm/image/image.h"

namespace dspm {

enum class Graphics { none, kitty, sixel };

/// What a terminal's answers to kGraphicsQuery say.
/// [kitty's protocol: sw.kovidgoyal.net/kitty/graphics-protocol; device attributes: DEC VT340, 4 is sixel]
Graphics graphics_of_answer(std::string_view answer);
/// Asks whether images are known, then for the device's attributes, which every terminal answers.
inline constexpr std::string_view kGraphicsQuery = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[c";

/// Asks the terminal behind `descriptor`; none if it does not answer within a part of a second, or is no terminal.
Graphics ask_for_graphics(int descriptor);

struct TerminalSize {
  int columns = 80, rows = 24;
  int cell_width = 8, cell_height = 16;  // in pixels
};
TerminalSize size_of_terminal(int descriptor);

/// The image at the cursor, which may then be anywhere below it. `columns` and `rows`: of kitty's cells that it covers.
std::string kitty_image(const Image& shown, int columns, int rows);
/// 216 colours with ordered dithering.
std::string sixel_image(const Image& shown);

}  // namespace dspm
