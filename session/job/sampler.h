// Reads what dspm takes from the Sampler directive.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"

namespace dspm {

struct SamplerSettings {
  std::optional<int> pixel_samples, seed;
  std::string noise;  // empty: it does not say
  bool independent_numbers = false;
};

SamplerSettings read_sampler(const std::optional<PluginUse>& use, Diagnostics& diagnostics);

/// Returns the names of pbrt's samplers. "independent" is what it says; all others stand for dspm's even numbers.
const std::vector<std::string>& sampler_names();
std::vector<ParamInfo> sampler_params(const std::string& name);

}  // namespace dspm
