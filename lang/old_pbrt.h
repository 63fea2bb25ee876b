// Scenes written for pbrt-v1, v2 or v3 look much like pbrt-v4's: these words distinguish them. Scenes for v3 are
// translated (lang/v3), older ones are not.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dspm/lang/directive.h"

namespace dspm {

/// Returns whether only versions of pbrt before v4 have this directive.
bool is_old_directive(std::string_view name);
/// A word in the directive that pbrt-v4 does not know but an older version did, and its location.
struct OldWord {
  std::string word;
  SourceLocation where;
};
std::optional<OldWord> old_word_in(const Directive& directive);
/// Returns true for directives that have no older namesake, such as Film "rgb".
bool is_certainly_new(const Directive& directive);
/// Returns whether the sign, or the file that it is in, belongs to pbrt-v1 or v2 rather than v3.
bool is_before_v3(const OldWord& sign);
/// The one error reported for a scene of pbrt-v1 or v2.
SyntaxError old_pbrt_error(const OldWord& sign);

}  // namespace dspm
