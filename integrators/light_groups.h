// The light that each group of lights brings, as outputs of their own: "light_key" is the light of all sources with
//   LightSource "spot" "string group" "key"
// and "light_other" the light of those without a group. Together they are the radiance, up to rounding. Besides, "volume" is
// the part of it that media send to the camera before it sees a surface.
#pragma once

#include <string>
#include <vector>

#include "dspm/integrators/output_info.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

inline constexpr const char* kVolumeOutput = "volume";

/// The outputs of all groups of the scene, and "volume" if it has media.
std::vector<OutputInfo> light_group_outputs(const Scene& scene);

/// The groups of a scene whose outputs a run gives; they count from 0. Light that media send is one more.
class LightGroups {
 public:
  static constexpr int kNone = -1;

  LightGroups() = default;
  LightGroups(const Scene& scene, const std::vector<std::string>& asked_outputs);

  int count() const { return static_cast<int>(outputs_.size()); }
  /// Returns the group of a light of the scene; kNone if no output asks for that group, or if `light` is negative.
  int of_light(int light) const { return light < 0 ? kNone : of_light_[static_cast<std::size_t>(light)]; }
  /// Returns the group of light that media send to the camera; kNone if no output asks for it.
  int of_media() const { return of_media_; }
  /// Returns the group whose output has that name, or kNone.
  int of_output(const std::string& name) const;

 private:
  std::vector<std::string> outputs_;  // by group
  std::vector<int> of_light_;
  int of_media_ = kNone;
};

}  // namespace dspm
