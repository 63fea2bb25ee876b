// Characters that look like those of the language but are others. Word processors and web pages put them into texts.
#pragma once

#include <optional>
#include <string_view>

namespace dspm {

struct Lookalike {
  std::string_view where;      // within the word
  const char *name, *instead;  // what it is, and what to write
};

/// Returns the first one in the word, which is UTF-8.
std::optional<Lookalike> find_lookalike(std::string_view word);

}  // namespace dspm
