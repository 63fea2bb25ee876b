// The projective cameras share this: the area of the screen that a pixel sees, the thin lens, and their parameters. All
// of it is in camera space: x to the right, y up, z forward.
#pragma once

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/cameras/camera.h"

namespace dspm {

/// The screen window, and the film's pixels on it.
struct Screen {
  float left = -1, right = 1, bottom = -1, top = 1;
  int width = 1, height = 1;  // of the film, in pixels

  Vec2 at(Vec2 film) const {
    return {left + film.x / static_cast<float>(width) * (right - left),
            top - film.y / static_cast<float>(height) * (top - bottom)};
  }
  /// The inverse of at().
  Vec2 film_at(Vec2 s) const {
    return {(s.x - left) / (right - left) * static_cast<float>(width),
            (top - s.y) / (top - bottom) * static_cast<float>(height)};
  }
  Vec2 pixel_size() const {
    return {(right - left) / static_cast<float>(width), (top - bottom) / static_cast<float>(height)};
  }
};

/// A disk in the plane z = 0 of the ray's origin; the image is sharp in the plane z = focal_distance.
struct ThinLens {
  float radius = 0, focal_distance = 1e6f;

  /// Returns the ray through another point of the lens that meets `central` in the plane of focus.
  Ray through(const Ray& central, Vec2 u) const;
  /// Returns that point of the lens, relative to its middle.
  Vec3 offset(Vec2 u) const;
};

struct Projection {
  Screen screen;
  ThinLens lens;
};

/// Reads the parameters that the projective cameras share. Wrong values are errors, and their defaults apply.
Projection read_projection(ParamReader& reader, const CameraContext& context);

/// Reads a number that must be above 0; otherwise reports an error and returns the fallback.
float read_positive(ParamReader& reader, std::string_view name, float fallback, std::string_view unit,
                    std::string_view sentence);

/// Carries a ray from camera space to the world; the direction is of unit length again.
inline Ray carried(const Transform& to_world, const Ray& ray) {
  return {to_world.point(ray.origin), normalize(to_world.vector(ray.direction))};
}

/// Maps the screen to the full image: the last step of Camera::image_from_camera().
Matrix4 image_from_screen(const Screen& screen);

/// Reads "shutteropen" and "shutterclose".
void read_shutter(ParamReader& reader);

/// Returns a sighting of the camera-space point `p` from `origin`, where an area of 1 perpendicular to the line of
/// sight covers `pixels` at p.
Sighting carried_across(const Transform& to_world, Vec2 film, const Vec3& p, const Vec3& origin, float pixels);
/// Returns a sighting where an area of 1 perpendicular to z covers `pixels` at p.
Sighting carried(const Transform& to_world, Vec2 film, const Vec3& p, const Vec3& origin, float pixels);

/// The edge of a square as large as the rectangle that the camera-space vectors (size.x, 0, 0) and (0, size.y, 0) span
/// in the world.
float mean_spacing(const Transform& to_world, Vec2 size);

}  // namespace dspm
