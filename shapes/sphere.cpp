// Shape "sphere" "float radius" 0.5
//
// A sphere around the origin, or the section of it between two heights and within an angle around z. Its normals point
// outward.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | radius    | 1       | radius |
// | zmin      | -radius | where the sphere is cut off below |
// | zmax      | radius  | where the sphere is cut off above |
// | phimax    | 360     | the angle that it covers around z (degrees) |
//
// u runs around z from the x axis, v from zmin to zmax. [Pharr, Jakob, Humphreys, Physically Based Rendering, 6.2]
#include "dspm/shapes/sphere.h"

#include <algorithm>
#include <optional>

#include "dspm/base/params/params.h"
#include "dspm/shapes/quadric_shape.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

class Sphere final : public QuadricShape<SphereSurface> {
 public:
  using QuadricShape::QuadricShape;

  std::optional<float> sphere_radius() const override {
    return surface().is_whole() ? std::optional(surface().radius()) : std::nullopt;
  }
};

}  // namespace

std::vector<MadeShape> make_sphere(ParamReader& reader) {
  const float radius = read_positive(reader, "radius", 1, "radius");
  const float z0 = reader.number("zmin", -radius, "scene units", "where the sphere is cut off below");
  const float z1 = reader.number("zmax", radius, "scene units", "where the sphere is cut off above");
  const Sweep sweep = read_sweep(reader);
  reader.finish();

  const auto [z_min, z_max] = std::minmax(z0, z1);
  std::vector<MadeShape> made;
  if (z_min == z_max || z_min >= radius || z_max <= -radius)
    reader.error("zmin", "nothing of the sphere is left between \"zmin\" and \"zmax\"");
  else
    made.push_back({std::make_unique<Sphere>(SphereSurface(radius, z_min, z_max, sweep)), std::nullopt});
  return made;
}

}  // namespace dspm
