// The interface to what a mesh knows of its vertices beyond what every surface has. Shapes know no textures and
// textures no shapes, so this stands between them.
#pragma once

#include <array>

#include "dspm/base/math/vec.h"

namespace dspm {

class VertexData {
 public:
  virtual ~VertexData() = default;

  /// Linear red, green and blue, and opacity, at a point of a triangle whose second and third vertex have the
  /// barycentrics `at`; all 1 if the mesh has no colours.
  virtual std::array<float, 4> vertex_colour(int triangle, Vec2 at) const = 0;

  /// The second texture coordinates at a point, and how they change with the first; equal to the first if the mesh has
  /// no second ones.
  struct SecondUv {
    Vec2 uv;
    Vec2 by_u{1, 0}, by_v{0, 1};
  };
  virtual SecondUv second_uv(int triangle, Vec2 at) const = 0;
};

/// A place on a mesh; `data` is null if the vertices have nothing more.
struct VertexPlace {
  const VertexData* data = nullptr;
  int triangle = 0;
  Vec2 at{};
};

}  // namespace dspm
