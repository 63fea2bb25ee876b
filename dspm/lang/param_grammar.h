// The grammar of parameter lists: `"rgb reflectance@12" [1 0 0] "bool twosided" true ...`.
#pragma once

#include "dspm/lang/lexer.h"
#include "dspm/params/params.h"

namespace dspm {

/// Reads parameters as long as quoted strings follow. Throws SyntaxError. With `accept_old_types`, the types point,
/// vector and normal3 mean point3, vector3 and normal; else they are errors with an old_word.
ParamList read_params(Lexer& lexer, bool accept_old_types);

/// Whether the string (with its quotes) is a known type, a blank and a name.
bool declares_param(std::string_view quoted);

}  // namespace dspm
