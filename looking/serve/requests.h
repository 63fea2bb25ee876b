// The texts in viewers' requests. Whatever they hold, they are parsed or refused.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "dspm/looking/serve/gallery.h"

namespace dspm {

inline constexpr std::size_t kMostWishes = 2048;

/// Reads the viewer's number, then lines of "frame output halvings version other". Returns nullopt if a line is
/// anything else, or if there are too many.
std::optional<Gallery::Request> parse_wishes(std::string_view text);

/// Reads nine numbers: eye, target, up. Returns nullopt if they are anything else, or span no view.
std::optional<std::array<double, 9>> parse_look_at(std::string_view text);

/// Reads a whole number within these bounds, and nothing else.
std::optional<int> parse_count(std::string_view text, int lowest, int highest);

}  // namespace dspm
