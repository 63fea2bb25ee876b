// The factories of this folder's plugins, one a file.
#pragma once

#include "shapes/shape.h"

namespace dspm {

MakeShape make_cylinder, make_disk, make_loopsubdiv, make_objmesh, make_plymesh, make_sphere, make_trianglemesh;

}  // namespace dspm
