// One directive as read, before it is applied.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/lang/clock.h"
#include "dspm/lang/directives.h"
#include "dspm/lang/lexer.h"
#include "dspm/lang/param_grammar.h"

namespace dspm {

/// A quoted argument, or a bare word.
struct Argument {
  std::string text;
  SourceLocation where;
};

struct Directive {
  const DirectiveInfo* info = nullptr;
  SourceLocation where;
  std::vector<Argument> words;  // of a LookAt that names its eye or target, both; empty: given by numbers
  std::vector<double> numbers;
  ParamList params;
};

/// The next directive; nullopt at the end of the text. After a SyntaxError, call Lexer::skip_to_directive to continue.
std::optional<Directive> read_directive(Lexer& lexer, OldTypes old_types, const Clock& clock = {});

}  // namespace dspm
