// A little modelling by code: profiles that are turned or carried along a path, and meshes put together. Faces are
// counterclockwise seen from outside.
#pragma once

#include <vector>

#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// A profile of points (radius, height) turned around the y axis in `sides` steps, from the bottom up for a body that
/// faces outwards. Points on the axis become one vertex.
MeshData lathe(const std::vector<Vec2>& profile, int sides);

/// A closed, convex, counterclockwise profile carried along a path that lies in a plane with the unit normal `side`:
/// the profile's x is `side`, its y is perpendicular to side and path. The ends stay open; a loop has none.
MeshData sweep(const std::vector<Vec2>& profile, const std::vector<Vec3>& path, const Vec3& side, bool loop = false);
std::vector<Vec2> ellipse(float radius_x, float radius_y, int corners);

MeshData box(const Vec3& low, const Vec3& high);

/// Adds a copy of `part` to `mesh`. Normals and texture coordinates are kept if `mesh` is empty or has them as well.
void append(MeshData& mesh, const MeshData& part, const Transform& placement = {});

/// The mesh with normals that are smooth where faces meet at less than the angle; at sharper edges vertices are
/// doubled.
MeshData with_normals(const MeshData& mesh, float crease_degrees);

}  // namespace dspm
