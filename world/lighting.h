// The lights of a scene with their states over the frames of the file, and how often each is chosen.
#pragma once

#include <memory>
#include <vector>

#include "lights/light.h"
#include "world/geometry.h"

namespace dspm {

struct WorldLight {
  Timeline<std::shared_ptr<const Light>> states;
  float probability = 0;  // in proportion to the mean power over all frames
  bool infinite = false;
  std::string name;  // for messages
};

/// The directives' lights, then the geometry's emitters in their order.
std::vector<WorldLight> make_lights(const SceneDescription& description, const Geometry& geometry, const Vec3& center,
                                    float radius, Diagnostics& diagnostics);

/// See SceneLight::alike.
std::vector<SceneLight::Alike> group_alike(const FrameStates<Light>& states);

}  // namespace dspm
