// A directive as scene text, on one line.
#pragma once

#include <string>

#include "dspm/lang/directive.h"

namespace dspm {

/// Writes the directive. Reading it gives the same directive, except for source locations.
std::string text_of(const Directive& directive);

}  // namespace dspm
