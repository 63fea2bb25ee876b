// The rays of an orthographic camera: along z of camera space, or through a lens for each pixel around its ray's origin.
#pragma once

#include <cmath>
#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/camera_space.h"
#include "dspm/cameras/screen.h"
#include "dspm/cameras/sighting.h"
#include "dspm/cameras/thin_lens.h"

namespace dspm {

class OrthographicRays {
 public:
  constexpr OrthographicRays(const Transform& to_world, const Screen& screen, const ThinLens& lens)
      : to_world_(to_world), screen_(screen), lens_(lens), spacing_(mean_spacing(to_world, screen_.pixel_size())) {}

  // These are as those of Camera.
  constexpr Ray ray(Vec2 film, Vec2 lens) const {
    const Vec2 s = screen_.at(film);
    return carried(to_world_, lens_.through({{s.x, s.y, 0}, {0, 0, 1}}, lens));
  }
  constexpr float pixel_spacing(float) const { return spacing_; }
  constexpr std::optional<Sighting> sight(const Vec3& p, Vec2 lens) const {
    const Vec3 local = to_world_.inverse_point(p), offset = lens_.offset(lens);
    if (!(local.z > 0)) return std::nullopt;
    const Vec3 middle =
        local - offset * (1 - local.z / lens_.focal_distance);  // of this pixel's lens, and of its focus
    const Vec2 size = screen_.pixel_size();
    return carried(to_world_, screen_.film_at({middle.x, middle.y}), local, Vec3{middle.x, middle.y, 0} + offset,
                   1 / std::abs(size.x * size.y));
  }

  constexpr const Screen& screen() const { return screen_; }

 private:
  Transform to_world_;
  Screen screen_;
  ThinLens lens_;
  float spacing_;
};

}  // namespace dspm
