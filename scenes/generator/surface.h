// Modelling by formulas: surfaces over the unit square, and the limbs and cushions of furniture that are made of them.
// Texture coordinates measure the surface: one unit of u or v is one unit of length, v runs along the grain.
#pragma once

#include <functional>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// A point for u and v in 0..1 and, for slopes, a little beyond.
using Surface = std::function<Vec3(float u, float v)>;
using TextureMap = std::function<Vec2(float u, float v)>;

/// A grid of columns x rows cells with normals; its outside is where dp/du x dp/dv points.
MeshData patch(int columns, int rows, const Surface& surface, const TextureMap& texture);

/// Where a limb passes, and how far it reaches along `side` and perpendicular to it.
struct Station {
  Vec3 at;
  float half_width, half_depth;
};

/// A leg, rail or arm: a section carried smoothly through the stations, its ends rounded. With the roundness 2 the
/// section is an ellipse, with more it comes nearer to a rectangle. `side` must not run along the limb; the texture's
/// seam is there.
MeshData limb(const std::vector<Station>& stations, const Vec3& side, float roundness, Vec2 texture_offset = {});

struct Cushion {
  float half_width, half_depth, half_height;  // in x, z, y; height at the welts
  float bulge;                                // of top and bottom in the middle, beyond half_height
  float corner;                               // radius in the plan
  float welt;                                 // radius of the cord along the edges
};

/// A boxed cushion around the origin: top, bottom, a band between them, and a cord over both seams.
MeshData cushion(const Cushion& shape);

}  // namespace dspm
