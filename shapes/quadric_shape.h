// What makes shapes of the plain surfaces of sphere, cylinder and disk: a Shape around one, and the reading of
// parameters that they share.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/plain_shape.h"
#include "dspm/shapes/quadric.h"
#include "dspm/shapes/shape.h"

namespace dspm {

template <class Surface>
class QuadricShape : public Shape {
 public:
  explicit QuadricShape(const Surface& surface) : surface_(surface) {}

  Bounds3 bounds(int) const override { return surface_.bounds(); }
  std::optional<PrimitiveHit> intersect(int, const Ray& ray) const override { return surface_.intersect(ray); }
  SurfacePoint surface_point(int, Vec2 uv) const override { return surface_.template surface_point<SurfacePoint>(uv); }
  float area(int) const override { return surface_.area(); }
  Vec2 sample_area(int, Vec2 u) const override { return surface_.sample_area(u); }
  std::optional<Vec2> area_numbers(int, const Vec3& p) const override { return surface_.area_numbers(p); }
  std::optional<PlainShape> plain() const override { return surface_; }

 protected:
  const Surface& surface() const { return surface_; }

 private:
  Surface surface_;
};

/// Reads a length that must be above 0.
inline float read_positive(ParamReader& reader, std::string_view name, float fallback, std::string_view sentence) {
  const float value = reader.number(name, fallback, "scene units", sentence);
  if (value > 0) return value;
  reader.error(name, std::string("\"").append(name).append("\" must be above 0"));
  return fallback;
}

/// Reads "phimax".
inline Sweep read_sweep(ParamReader& reader) {
  const float degrees = reader.number("phimax", 360, "degrees", "the angle that the shape covers around the z axis");
  if (!(degrees > 0)) reader.error("phimax", "\"phimax\" must be above 0");
  return Sweep(degrees);
}

}  // namespace dspm
