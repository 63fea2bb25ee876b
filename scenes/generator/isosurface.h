// Smooth bodies from formulas: the surface where a function of space is zero, as a closed mesh.
#pragma once

#include <functional>

#include "shapes/triangle_mesh.h"

namespace dspm {

/// Negative inside.
using Field = std::function<double(const Vec3&)>;

struct MeshingGoal {
  float angle = 25;        // degrees: no triangle has a smaller one
  float size = 0.1f;       // radius of the largest triangle's circumcircle
  float distance = 1e-2f;  // from triangles to the surface
};

/// The part of the surface within `radius` of `middle`, which must be inside. Closed and without self-intersections,
/// the same on every run; one piece of surface, the outside outside.
MeshData isosurface(const Field& field, const Vec3& middle, float radius, const MeshingGoal& goal);

/// The field's direction of growth there, of unit length.
Vec3 gradient(const Field& field, const Vec3& p);

}  // namespace dspm
