// The effect of variations on Dynamic blocks and lights, in each frame of the file.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"

namespace dspm {

inline constexpr int kAlwaysThere = -1;  // instead of a Dynamic block: static

/// Returns in which frames of the file the contents of a Dynamic block are there. A block that one variation of an axis
/// shows is hidden in the axis's others; it is there if neither an axis nor a block around it hides it.
std::vector<bool> presence(const SceneDescription& scene, int dynamic_block);

/// Returns a light's parameters in a frame of the file; `scale` is multiplied by the factors that the frame's
/// variations give to lights of that name.
ParamList light_params(const SceneDescription& scene, const PluginUse& use, const std::string& name, FileFrame frame);

}  // namespace dspm
