// The table of shapes: one line for each.
#include "shapes/plugins.h"

namespace dspm {

std::span<const Plugin<MakeShape>> shape_plugins() {
  static constexpr Plugin<MakeShape> table[] = {
      {"cylinder", "the mantle of a cylinder", make_cylinder},
      {"disk", "a disk, ring or sector", make_disk},
      {"loopsubdiv", "the smooth surface of a coarse mesh of triangles", make_loopsubdiv},
      {"objmesh", "triangles from an OBJ file", make_objmesh},
      {"plymesh", "triangles from a PLY file", make_plymesh},
      {"sphere", "a sphere or a part of it", make_sphere},
      {"trianglemesh", "triangles in the scene's text", make_trianglemesh},
  };
  return table;
}

std::span<const std::string_view> unbuilt_shapes() {
  static constexpr std::string_view names[] = {"bilinearmesh", "curve"};
  return names;
}

}  // namespace dspm
