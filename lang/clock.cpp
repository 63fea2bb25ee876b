#include "dspm/lang/clock.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace dspm {

std::optional<Moment> Clock::moment_of(const Lexer& lexer, std::string_view piece, std::string_view text) const {
  const bool in_seconds = text.ends_with('s');
  if (in_seconds) text.remove_suffix(1);
  double number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  if (in_seconds) {
    if (!fps)
      lexer.fail(piece, "seconds need the number of frames per second",
                 "give it before the first key: Frames 48 \"float fps\" 24");
    number = first.frames() + 1 + number * *fps;
  }
  if (!(number > lowest() - 1 && number <= kLastFrame))
    return std::nullopt;  // a shutter may open before the first frame
  constexpr double kSteps = 65536;
  return Moment(std::round((number - 1) * kSteps) / kSteps);
}

std::string number_of(Moment moment) {
  constexpr double kDigits = 1e4;
  return fmt::format("{}", std::round((moment.frames() + 1) * kDigits) / kDigits);
}

}  // namespace dspm
