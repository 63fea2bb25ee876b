// The light of camera paths whose first surface is a shadow catcher. It is no part of the image; shadow_catcher.h turns
// it into the image's alpha.
#pragma once

#include <vector>

#include "dspm/integrators/output_info.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The output of integrators that know shadow catchers.
inline constexpr const char* kCaughtLight = "caught";

inline bool has_catchers(const Scene& scene) { return scene.without_objects != nullptr || scene.is_without_objects; }

inline OutputInfo caught_output() {
  return {kCaughtLight, {"caught.R", "caught.G", "caught.B"}, "light on shadow catchers"};
}
/// Appends caught light to `outputs` if the scene has catchers.
inline std::vector<OutputInfo> with_caught_light(std::vector<OutputInfo> outputs, bool has_catchers) {
  if (has_catchers) outputs.push_back(caught_output());
  return outputs;
}

}  // namespace dspm
