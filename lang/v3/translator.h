// Translates pbrt-v3 to v4, directive by directive: plain data to plain data, no plugin is known.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "dspm/lang/directive.h"
#include "dspm/lang/v3/kinds.h"

namespace dspm::v3 {

class Translator {
 public:
  using Defined = std::map<std::string, int>;  // how often each name has been

  /// Returns what replaces the directive in v4, mostly one directive. Throws NoCounterpart.
  std::vector<Directive> translate(Directive directive);
  void settle(Header& header) { settle_header(header, remarks_); }

  /// Returns one line: what was translated, and what is only close.
  std::string summary() const;

 private:
  void rename(Directive& directive);

  Remarks remarks_;
  Defined materials_, objects_;
  std::array<Defined, 2> textures_;  // of colours, of numbers
};

}  // namespace dspm::v3
