// The table of shapes: one line for each.
#include "dspm/shapes/shape.h"

namespace dspm {

MakeShape make_bilinearmesh, make_curve, make_cylinder, make_disk, make_loopsubdiv, make_objmesh, make_plymesh,
    make_sphere, make_trianglemesh;

PluginTable<Plugin<MakeShape>>& shape_plugins() {
  static PluginTable<Plugin<MakeShape>> table(
      "shape", {
                   {"bilinearmesh", "bilinear patches: quadrilaterals, bent if their corners are not in a plane",
                    make_bilinearmesh},
                   {"curve", "hair, fur and grass: curves with a width", make_curve},
                   {"cylinder", "a cylinder without caps", make_cylinder},
                   {"disk", "a disk, ring or sector", make_disk},
                   {"loopsubdiv", "the smooth surface of a coarse mesh of triangles", make_loopsubdiv},
                   {"objmesh", "triangles from an OBJ file", make_objmesh},
                   {"plymesh", "triangles from a PLY file", make_plymesh},
                   {"sphere", "a sphere or a part of it", make_sphere},
                   {"trianglemesh", "triangles in the scene file", make_trianglemesh},
               });
  return table;
}

}  // namespace dspm
