// The grammar of parameter lists: `"rgb reflectance@12" [1 0 0] "bool twosided" true ...`.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/lang/clock.h"
#include "dspm/lang/lexer.h"

namespace dspm {

/// The meaning of the types of older versions of pbrt. They are errors with an old_word; or point, vector and normal3
/// mean point3, vector3 and normal, as in .dsc files; or color and xyz mean rgb, too, as in pbrt-v3, where a parameter
/// that is given twice has its last value.
enum class OldTypes { errors, synonyms, v3 };

/// Reads parameters as long as quoted strings follow. Throws SyntaxError.
ParamList read_params(Lexer& lexer, OldTypes old_types, const Clock& clock);

/// Returns whether the string (with its quotes) is a known type, a blank and a name.
bool declares_param(std::string_view quoted);

}  // namespace dspm
