// Smooth bodies from formulas: the surface where a function of space is zero, as a closed mesh.
#pragma once

#include <functional>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"
#include "scenes/generator/simplify.h"

namespace dspm {

/// Negative inside, and near the surface about the distance to it; it must not change much faster than distance does.
using Field = std::function<double(const Vec3&)>;

/// The surface in the box `bounds`, which it must not cross: closed, manifold, facing outwards. Sampled in cubes of the
/// width `cell`, then thinned out to about `triangles`, of the same size unless `coarseness` says otherwise.
MeshData isosurface(
    const Field& field, const Bounds3& bounds, float cell, int triangles,
    const Coarseness& coarseness = [](const Vec3&) { return 1; });

/// The direction in which the field grows there, of unit length.
Vec3 gradient(const Field& field, const Vec3& p);

}  // namespace dspm
