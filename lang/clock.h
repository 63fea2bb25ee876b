// When a key is: at frame `12`, between frames at `12.5`, or `1.5s` after the first frame.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dspm/base/math/moments.h"
#include "dspm/lang/lexer.h"

namespace dspm {

inline constexpr int kLastFrame = 1'000'000;  // the highest number of a frame

/// What numbers of frames and seconds mean in a scene.
struct Clock {
  Moment first;                              // the scene's first frame
  std::optional<double> fps = std::nullopt;  // frames per second, if given

  /// Frames count from 1, or from the scene's first if that is 0.
  int lowest() const { return first < Moment() ? first.number() : 1; }
  /// Nullopt if `text` is no time. Kept to 1/65536 of a frame: so sums are exact, and the cycles of keys meet bit by
  /// bit. Throws SyntaxError at `piece` for seconds without a number of frames per second.
  std::optional<Moment> moment_of(const Lexer& lexer, std::string_view piece, std::string_view text) const;
};

/// As texts call it: "12" or "12.5".
std::string number_of(Moment moment);

}  // namespace dspm
