// A little modelling by code: profiles that are turned or swept, and meshes put together. Faces are counterclockwise
// seen from outside.
#pragma once

#include "core/transform.h"
#include "shapes/triangle_mesh.h"

namespace dspm {

/// A profile of points (radius, height) turned around the y axis in `sides` steps, from the bottom up for a body whose
/// outside is outside. Points on the axis become one vertex. Adjacent faces share vertices.
MeshData lathe(const std::vector<Vec2>& profile, int sides);

/// Adds a copy of `part` to `mesh`. Normals and texture coordinates are kept if `mesh` is empty or has them as well.
void append(MeshData& mesh, const MeshData& part, const Transform& placement = {});

}  // namespace dspm
