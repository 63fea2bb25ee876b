// Camera "spherical" "string mapping" "equirectangular"
//
// Sees all around from one point. The middle of the picture is +z of camera space if it is latitude and longitude: the
// top row looks up, along +y, and the columns turn from +x over +z. With the equal-area mapping, of a square picture,
// +y is the middle. Such pictures are skies for the infinite light.
//
// | parameter | default   | meaning |
// | --------- | --------- | ------- |
// | mapping   | equalarea | equalarea: pbrt-v4's squares; equirectangular: latitude and longitude |
// | shutteropen, shutterclose | 0, 0 | frames: what moves between them blurs; in .pbrt files seconds, 0 and 1 |
//
// lensradius, focaldistance, frameaspectratio and screenwindow have no effect, as in pbrt-v4.
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 5.3; Clarberg 2008, Fast Equal-Area Mapping of the
// (Hemi)Sphere using SIMD]
#include <algorithm>
#include <cmath>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sphere_mapping.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/cameras/camera.h"
#include "dspm/cameras/camera_space.h"
#include "dspm/cameras/projection.h"

namespace dspm {
namespace {

// Mappings have z up, camera space y.
Vec3 swapped(const Vec3& v) { return {v.x, v.z, v.y}; }

/// Returns where a place beyond an edge of the octahedral square really is: on the same edge, mirrored, and two squares
/// further the same again.
Vec2 wrapped(Vec2 p) {
  if (p.x < -1 || p.x > 2) p.x -= 2 * std::floor(p.x / 2);
  if (p.y < -1 || p.y > 2) p.y -= 2 * std::floor(p.y / 2);
  if (p.x < 0) p = {-p.x, 1 - p.y};
  if (p.x > 1) p = {2 - p.x, 1 - p.y};
  if (p.y < 0) p = {1 - p.x, -p.y};
  if (p.y > 1) p = {1 - p.x, 2 - p.y};
  return p;
}

class Spherical final : public Camera {
 public:
  Spherical(const CameraContext& context, SphereMapping mapping)
      : to_world_(context.to_world),
        mapping_(mapping),
        width_(static_cast<float>(context.width)),
        height_(static_cast<float>(context.height)),
        spacing_at_1_(std::sqrt(4 * kPi / (width_ * height_))) {}

  Ray ray(Vec2 film, Vec2) const override {
    Vec2 place{film.x / width_, film.y / height_};
    if (mapping_ == SphereMapping::equal_area) place = wrapped(place);
    return carried(to_world_, {{}, swapped(direction_at(mapping_, place))});
  }

  float pixel_spacing(float path_length) const override { return path_length * spacing_at_1_; }

  std::optional<Sighting> sight(const Vec3& p, Vec2) const override {
    const Vec3 local = to_world_.inverse_point(p), w = swapped(normalize(local));
    const float distance2 = length2(local);
    if (!(distance2 > 0)) return std::nullopt;
    const Vec2 place = place_of(mapping_, w), film{place.x * width_, place.y * height_};
    // A filter reaches across an edge to the other side of the picture, where a light path would miss it.
    const float inside = std::min(std::min(film.x, width_ - film.x), std::min(film.y, height_ - film.y));
    if (inside < kWidestFilter) return std::nullopt;
    const float sine = rounded::hypot(w.x, w.y);
    const float per_angle = mapping_ == SphereMapping::equal_area ? 1 / (4 * kPi) : 1 / (2 * kPi * kPi * sine);
    return carried_across(to_world_, film, local, {}, per_angle * width_ * height_ / distance2);
  }

 private:
  static constexpr float kWidestFilter = 8;  // pixels; pbrt's usual ones have 0.5 to 4

  Transform to_world_;
  SphereMapping mapping_;
  float width_, height_;
  float spacing_at_1_;  // of the mean pixel
};

}  // namespace

std::unique_ptr<Camera> make_spherical(ParamReader& reader, const CameraContext& context) {
  const std::string mapping =
      reader.choice("mapping", "equalarea", {"equalarea", "equirectangular"}, "how the picture covers the sphere");
  read_shutter(reader);
  for (const char* name : {"lensradius", "focaldistance", "frameaspectratio", "screenwindow"})
    reader.without_effect(name);
  reader.finish();
  return std::make_unique<Spherical>(
      context, mapping == "equalarea" ? SphereMapping::equal_area : SphereMapping::equirectangular);
}

}  // namespace dspm
