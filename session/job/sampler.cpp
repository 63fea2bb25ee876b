#include "dspm/session/job/sampler.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/params/errors.h"
#include "dspm/integrators/common_params.h"

namespace dspm {
namespace {

constexpr const char* kIndependent = "independent";

/// pbrt's samplers have different parameters; here each accepts all, so a scene may change its sampler alone.
SamplerSettings read(ParamReader& reader, const std::string& type) {
  SamplerSettings settings;
  const int samples = reader.integer("pixelsamples", type == kIndependent ? 4 : 16, "",
                                     "camera paths per pixel, or iterations; the default is that of .pbrt files"),
            seed = reader.integer("seed", 0, "", "of the random numbers");
  const std::string noise =
      reader.choice("noise", kNoises.front(), kNoises, "as the integrator's, which takes precedence");
  const int across = reader.integer("xsamples", 4, "", "of \"stratified\": times ysamples, the same as pixelsamples"),
            down = reader.integer("ysamples", 4, "", "likewise");
  reader.text("randomization", "", "without effect");
  reader.flag("jitter", true, "without effect");
  if (reader.has("pixelsamples")) settings.pixel_samples = samples;
  if (type == "stratified" && (reader.has("xsamples") || reader.has("ysamples")))
    settings.pixel_samples = across * down;
  if (reader.has("seed")) settings.seed = seed;
  if (reader.has("noise")) settings.noise = noise;
  if (settings.pixel_samples && *settings.pixel_samples < 1)
    reader.error("pixelsamples", "there must be at least one sample");
  return settings;
}

}  // namespace

SamplerSettings read_sampler(const std::optional<PluginUse>& use, Diagnostics& diagnostics) {
  if (!use) return {};
  const std::vector<std::string>& names = sampler_names();
  if (std::find(names.begin(), names.end(), use->type) == names.end()) {
    diagnostics.error(use->type_where, fmt::format("unknown sampler \"{}\"", use->type),
                      did_you_mean(use->type, names));
    return {};
  }
  if (use->type != kIndependent)
    diagnostics.note(use->where,
                     fmt::format("the sampler \"{}\" is dspm's own: even numbers, as \"zsobol\" has", use->type));
  ParamReader reader(use->params, fmt::format("sampler \"{}\"", use->type), use->where, diagnostics);
  SamplerSettings settings = read(reader, use->type);
  settings.independent_numbers = use->type == kIndependent;
  reader.finish();
  return settings;
}

const std::vector<std::string>& sampler_names() {
  static const std::vector<std::string> names = {"zsobol",  "paddedsobol", "sobol",     "halton",
                                                 "pmj02bn", kIndependent,  "stratified"};
  return names;
}

std::vector<ParamInfo> sampler_params(const std::string& name) {
  std::vector<ParamInfo> described;
  Diagnostics ignored;
  ParamReader reader(described, ignored);
  read(reader, name);
  return described;
}

}  // namespace dspm
