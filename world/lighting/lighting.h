// The lights of a scene with their states over the frames of the file, and how often each is chosen.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lights/light.h"
#include "dspm/lights/photon_controls.h"
#include "dspm/world/lighting/bounding_sphere.h"
#include "dspm/world/objects/content_key.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/media.h"

namespace dspm {

struct WorldLight {
  Timeline<std::shared_ptr<const Light>> states;
  std::vector<float> powers;     // by state: luminance
  std::vector<ContentKey> keys;  // by state: what it is made of
  float probability = 0;         // in proportion to the mean power over the base of the file's frames
  PhotonControls controls;
  std::string group;
  std::optional<LightBounds> bounds;    // of the states over the base, together; nullopt: some of them light everything
  std::vector<std::vector<int>> alike;  // groups of states whose photons start like the first one's
  bool infinite = false;
  bool is_delta = false;   // neither infinite nor of a shape that can be seen
  std::string name;        // for messages
  std::string short_name;  // as the scene gives it, or of its type or its shape
  const PluginUse* use = nullptr;
  int medium_interface = -1;  // of what emits it, see ShapeUse
  int glow_of = kNoMedium;    // the medium that gives it off

  /// Returns the power in a frame of the file; 0 if the light is not there.
  double power(FileFrame frame) const {
    const int state = states.at(frame);
    return state < 0 ? 0 : static_cast<double>(powers[static_cast<std::size_t>(state)]);
  }
};

/// Returns the directives' lights, then the geometry's emitters in their order, then what media give off. Those that are no
/// shape's are shared with `sooner`, lights of the same scene at another time, if they are made of the same; it may be null.
std::vector<WorldLight> make_lights(const SceneDescription& description, const Geometry& geometry, const Looks& looks,
                                    const Media& media, const BoundingSphere& sphere,
                                    const std::vector<WorldLight>* sooner, Diagnostics& diagnostics);

/// Returns SceneLight::alike of a light in the scene of these frames of the file.
std::vector<SceneLight::Alike> alike_in(const WorldLight& light, const std::vector<FileFrame>& frames);

}  // namespace dspm
