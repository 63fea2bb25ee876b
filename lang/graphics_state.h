// The state while a scene's text is read; saved and restored by blocks.
#pragma once

#include <array>
#include <memory>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/current_transform.h"
#include "dspm/lang/description.h"

namespace dspm {

/// The targets for which `Attribute` can set defaults.
enum class AttributeTarget { shape, light, material, medium, texture };
inline constexpr int kAttributeTargets = 5;

inline constexpr const char* kBlurParam = "blur";  // of DynamicBegin and Shape

struct GraphicsState {
  CurrentTransform ctm;  // world from local, before WorldBegin camera from world
  ColourSpace space = ColourSpace::srgb;
  bool reverse_orientation = false;
  MaterialRef material;
  int area_light = -1;
  int medium_interface = -1;
  int dynamic_block = -1;
  bool blurs = true;                                                                // of shapes, lights and instances
  std::array<std::shared_ptr<const ParamList>, kAttributeTargets> attributes = {};  // null: none; blocks share them
};

}  // namespace dspm
