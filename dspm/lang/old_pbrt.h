// Scenes written for pbrt-v1, v2 or v3 look much like pbrt-v4's: by which words they are told apart.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dspm/lang/directive.h"

namespace dspm {

/// The directive's name, if pbrt had it before v4 only.
bool is_old_directive(std::string_view name);
/// A word in the directive that pbrt-v4 does not know but an older one did, and where it stands.
struct OldWord {
  std::string word;
  SourceLocation where;
};
std::optional<OldWord> old_word_in(const Directive& directive);
/// Film "rgb" and its like have no older namesake.
bool is_certainly_new(const Directive& directive);
/// The one thing to be told about such a scene.
SyntaxError old_pbrt_error(const OldWord& sign);

}  // namespace dspm
