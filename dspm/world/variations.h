// What variations make of parts and lights, frame by frame of the file.
#pragma once

#include <string>
#include <vector>

#include "dspm/lang/description.h"
#include "dspm/math/frames.h"
#include "dspm/params/params.h"

namespace dspm {

inline constexpr int kAlwaysThere = -1;  // the Dynamic block of what is static

/// In which frames of the file the things of a Dynamic block are there. A part that one of an axis's variations shows
/// is hidden in its others; it is there where no axis hides it, nor a block around it.
std::vector<bool> presence(const SceneDescription& scene, int dynamic_block);

/// A light's parameters in a frame of the file; `scale` is multiplied by what the frame's variations say of the lights
/// of that name.
ParamList light_params(const SceneDescription& scene, const PluginUse& use, const std::string& name, Frame frame);

}  // namespace dspm
