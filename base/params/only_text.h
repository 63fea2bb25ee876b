// The text of a parameter that has one.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "dspm/base/params/params.h"

namespace dspm {

/// Returns the text, or null if there is no parameter, or if it has another number of values or values of another type.
inline const std::string* only_text(const Param* param) {
  const auto* texts = param != nullptr ? std::get_if<std::vector<std::string>>(&param->values) : nullptr;
  return texts != nullptr && texts->size() == 1 ? &texts->front() : nullptr;
}

}  // namespace dspm
