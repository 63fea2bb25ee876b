#include "dspm/materials/coat.h"

#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"

namespace dspm {

RandomWalk read_random_walk(ParamReader& reader, bool loses) {
  const float g = reader.number("g", 0, "", "asymmetry of a medium in the coat; only 0 is supported");
  const auto albedo =
      reader.rgb_or_texture("albedo", Rgb(0), SpectrumRole::albedo, "of that medium; only 0 is supported");
  const auto refuse = [&](std::string_view name) {
    reader.diagnostics().unsupported(reader.where(name),
                                     reader.subject() + ": a medium in the coat is not supported by dspm",
                                     "with --lenient, the coat is clear");
  };
  if (g != 0) refuse("g");
  if (!albedo.texture.empty() || !is_black(albedo.value)) refuse("albedo");
  const float thickness = reader.number("thickness", 0.01f, "", "of the coat; has no effect with energycompensation");
  const int max_depth =
      reader.integer("maxdepth", 10, "", "of pbrt's random walk; has no effect with energycompensation");
  reader.integer("nsamples", 1, "", "of pbrt's random walk; without effect");
  for (const char* name : {"thickness", "maxdepth", "nsamples"}) {
    if (loses || !reader.has(name)) continue;
    reader.warning(name, "parameter \"" + std::string(name) + "\" of " + reader.subject() + " has no effect in dspm",
                   "with \"energycompensation\" false the coat loses light as pbrt's random walk does");
    break;
  }
  if (!(thickness >= 0)) reader.error("thickness", "\"thickness\" must not be negative");
  if (max_depth < 0) reader.error("maxdepth", "\"maxdepth\" must not be negative");
  return {thickness, max_depth / 2 + max_depth % 2};
}

}  // namespace dspm
