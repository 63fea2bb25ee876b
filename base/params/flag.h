// A parameter that says yes or no, before a plugin reads it.
#pragma once

#include <variant>
#include <vector>

#include "dspm/base/params/params.h"

namespace dspm {

/// Returns whether the list has a bool of that name that is true.
inline bool is_true(const ParamList& params, const char* name) {
  const Param* const param = params.find(name);
  const auto* values = param != nullptr ? std::get_if<std::vector<bool>>(&param->values) : nullptr;
  return values != nullptr && values->size() == 1 && values->front();
}

}  // namespace dspm
