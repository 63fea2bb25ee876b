// Where camera paths start. Plugins: orthographic.cpp is the shortest to copy; plugins.cpp is the table.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/params.h"
#include "core/registry.h"
#include "core/transform.h"

namespace dspm {

class Camera {
 public:
  virtual ~Camera() = default;
  /// `film` in pixels of the full image from its upper left corner; `lens` in [0,1)^2. Direction of unit length.
  virtual Ray ray(Vec2 film, Vec2 lens) const = 0;
  /// The distance between neighbouring pixels' rays, in world units, at a path length from the camera.
  virtual float pixel_spacing(float path_length) const = 0;
};

struct CameraContext {
  Transform to_world;
  int width = 1, height = 1;  // of the full image
};

using MakeCamera = std::unique_ptr<Camera>(ParamReader&, const CameraContext&);
std::span<const Plugin<MakeCamera>> camera_plugins();
std::span<const std::string_view> unbuilt_cameras();  // pbrt's others, for find_plugin's `not_built`

}  // namespace dspm
