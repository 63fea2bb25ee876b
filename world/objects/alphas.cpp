#include "dspm/world/objects/alphas.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "dspm/shapes/cutout.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/param_states.h"
#include "dspm/world/objects/variations.h"

namespace dspm {
namespace {

bool is_alpha(const Param& param) { return param.name == kAlphaParam; }

}  // namespace

ParamList without_alpha(const ParamList& params) {
  ParamList rest = params;
  std::erase_if(rest.params, is_alpha);
  return rest;
}

int Alphas::of(const ShapeUse& use) {
  ParamList alpha = use.params;
  std::erase_if(alpha.params, [](const Param& param) { return !is_alpha(param); });
  if (alpha.params.empty()) return -1;
  const int errors = diagnostics_.error_count();
  const std::vector<bool> present = presence(description_, use.dynamic_block);
  for (const ShapeState& state : param_states(alpha, description_.frames, present).states) {
    ParamReader reader(state.params, subject_of(use), use.where, diagnostics_);
    read_alpha(reader);
    if (diagnostics_.error_count() > errors) return -1;
  }
  return looks_.add_number(std::move(alpha), use.where, use.blurs);
}

void Alphas::set(WorldShape& shape, int alpha, int state) const {
  const std::optional<float> constant = alpha < 0 ? 1.f : looks_.constant(alpha, state);
  if (constant && *constant >= 1) return;
  shape.alpha = alpha, shape.alpha_state = state;
  shape.nowhere = constant && !(*constant > 0);
}

}  // namespace dspm
