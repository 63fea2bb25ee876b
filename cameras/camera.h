// A camera decides where camera paths start. Plugins: orthographic.cpp is the shortest to copy; plugins.cpp is the
// table.
#pragma once

#include <memory>
#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/cameras/sighting.h"

namespace dspm {

class Camera {
 public:
  virtual ~Camera() = default;
  /// The ray through `film`, in pixels of the full image from its upper left corner, and through `lens`, in [0, 1)^2.
  /// Its direction has unit length.
  virtual Ray ray(Vec2 film, Vec2 lens) const = 0;
  /// The factor to the radiance that this ray sees; 0 if the ray does not get through the lens.
  virtual float weight(Vec2 /*film*/, Vec2 /*lens*/) const { return 1; }
  /// The distance between the rays of neighbouring pixels, in world units, after this path length from the camera.
  virtual float pixel_spacing(float path_length) const = 0;
  /// Returns the film position whose ray(film, lens) passes through p; nullopt if no ray does, or if the camera cannot
  /// compute it. Light that is traced towards a camera that returns nullopt does not reach it.
  virtual std::optional<Sighting> sight(const Vec3& /*p*/, Vec2 /*lens*/) const { return std::nullopt; }
  /// Returns the matrix from camera space (x to the right, y up, z forward) to the full image: its x / w and y / w
  /// reach from -1 to 1, to the right and up. Nullopt if no matrix does that.
  virtual std::optional<Matrix4> image_from_camera() const { return std::nullopt; }
};

struct CameraContext {
  Transform to_world;
  int width = 1, height = 1;     // of the full image
  float film_diagonal = 0.035f;  // in metres
};

using MakeCamera = std::unique_ptr<Camera>(ParamReader&, const CameraContext&);
PluginTable<Plugin<MakeCamera>>& camera_plugins();

}  // namespace dspm
