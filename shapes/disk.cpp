// Shape "disk" "float radius" 0.5
//
// A disk, ring or sector in the plane z = height. Its normal is +z.
//
// | parameter   | default | meaning |
// | ----------- | ------- | ------- |
// | height      | 0       | z of the plane |
// | radius      | 1       | outer radius |
// | innerradius | 0       | radius of the hole |
// | phimax      | 360     | the angle that it covers around z (degrees) |
//
// u runs around z from the x axis, v from the rim inward. [Pharr, Jakob, Humphreys, Physically Based
// Rendering, 6.4]
#include "dspm/shapes/disk.h"

#include "dspm/base/params/params.h"
#include "dspm/shapes/quadric_shape.h"
#include "dspm/shapes/shape.h"

namespace dspm {

std::vector<MadeShape> make_disk(ParamReader& reader) {
  const float height = reader.number("height", 0, "scene units", "z of the disk's plane");
  const float radius = read_positive(reader, "radius", 1, "outer radius");
  const float inner = reader.number("innerradius", 0, "scene units", "radius of the hole");
  const Sweep sweep = read_sweep(reader);
  reader.finish();

  std::vector<MadeShape> made;
  if (inner < 0 || inner >= radius)
    reader.error("innerradius", "\"innerradius\" must be at least 0 and below \"radius\"");
  else
    made.push_back(
        {std::make_unique<QuadricShape<DiskSurface>>(DiskSurface(height, radius, inner, sweep)), std::nullopt});
  return made;
}

}  // namespace dspm
