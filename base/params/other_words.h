// Knows what other renderers call things, for suggestions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dspm {

/// Returns those of `candidates` that mean what another renderer calls `word`, best first.
std::vector<std::string> meant_by(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace dspm
