// Shape "cylinder" "float radius" 0.5 "float zmin" 0 "float zmax" 2
//
// A cylinder around the z axis, without caps. Its normals point away from the axis.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | radius    | 1       | radius |
// | zmin      | -1      | lower end |
// | zmax      | 1       | upper end |
// | phimax    | 360     | the angle that it covers around z (degrees) |
//
// u runs around z from the x axis, v from zmin to zmax. [Pharr, Jakob, Humphreys, Physically Based Rendering, 6.3]
#include "dspm/shapes/cylinder.h"

#include <algorithm>

#include "dspm/base/params/params.h"
#include "dspm/shapes/quadric_shape.h"
#include "dspm/shapes/shape.h"

namespace dspm {

std::vector<MadeShape> make_cylinder(ParamReader& reader) {
  const float radius = read_positive(reader, "radius", 1, "radius");
  const float z0 = reader.number("zmin", -1, "scene units", "lower end");
  const float z1 = reader.number("zmax", 1, "scene units", "upper end");
  const Sweep sweep = read_sweep(reader);
  reader.finish();

  std::vector<MadeShape> made;
  if (z0 == z1)
    reader.error("zmin", "\"zmin\" and \"zmax\" are equal: the cylinder has no height");
  else
    made.push_back({std::make_unique<QuadricShape<CylinderSurface>>(
                        CylinderSurface(radius, std::min(z0, z1), std::max(z0, z1), sweep)),
                    std::nullopt});
  return made;
}

}  // namespace dspm
