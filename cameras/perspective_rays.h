// The rays of a perspective camera: through the origin of camera space, or through a thin lens there.
#pragma once

#include <cmath>
#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/camera_space.h"
#include "dspm/cameras/screen.h"
#include "dspm/cameras/sighting.h"
#include "dspm/cameras/thin_lens.h"

namespace dspm {

class PerspectiveRays {
 public:
  /// Takes the degrees that -1 to 1 of the screen cover.
  constexpr PerspectiveRays(const Transform& to_world, const Screen& screen, const ThinLens& lens, float fov)
      : to_world_(to_world), screen_(screen), lens_(lens), scale_(rounded::tan(fov / 360 * kPi)) {
    const float forward = length(to_world.vector({0, 0, 1}));
    spacing_at_1_ = mean_spacing(to_world, screen_.pixel_size() * scale_) / forward;
  }

  // These are as those of Camera.
  constexpr Ray ray(Vec2 film, Vec2 lens) const {
    const Vec2 s = screen_.at(film) * scale_;
    return carried(to_world_, lens_.through({{}, normalize({s.x, s.y, 1})}, lens));
  }
  constexpr float pixel_spacing(float path_length) const { return path_length * spacing_at_1_; }
  constexpr std::optional<Sighting> sight(const Vec3& p, Vec2 lens) const {
    const Vec3 local = to_world_.inverse_point(p), origin = lens_.offset(lens);
    if (!(local.z > 0)) return std::nullopt;
    // The central ray of that pixel meets the ray from `origin` in the plane of focus.
    const Vec2 s{(local.x - origin.x) / local.z + origin.x / lens_.focal_distance,
                 (local.y - origin.y) / local.z + origin.y / lens_.focal_distance};
    const Vec2 size = screen_.pixel_size() * (scale_ * local.z);
    return carried(to_world_, screen_.film_at(s * (1 / scale_)), local, origin, 1 / std::abs(size.x * size.y));
  }

  constexpr const Screen& screen() const { return screen_; }
  /// The factor from the screen to the plane z = 1.
  constexpr float scale() const { return scale_; }

 private:
  Transform to_world_;
  Screen screen_;
  ThinLens lens_;
  float scale_;
  float spacing_at_1_ = 0;  // of neighbouring pixels in the plane at distance 1
};

}  // namespace dspm
