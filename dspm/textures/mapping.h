// From a point on a surface to the plane in which pictures and checkerboards lie.
//
//   | mapping                              | "uv"     | or spherical, cylindrical, planar                         |
//   | uscale, vscale, udelta, vdelta       | 1, 1, 0, 0 | of uv: s = uscale u + udelta; planar takes the deltas too |
//   | v1, v2                               | x, y     | of planar: s = v1 . p + udelta, t = v2 . p + vdelta       |
//
// All but uv use the point in the texture's own space: the transform in force where the texture was defined.
#pragma once

#include "dspm/math/transform.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"
#include "dspm/textures/texture.h"

namespace dspm {

class TextureMapping {
 public:
  enum class Kind { uv, spherical, cylindrical, planar };

  static TextureMapping read(ParamReader& reader, const Transform& world_from_texture);

  Vec2 at(const TexturePoint& point) const;

 private:
  Kind kind_ = Kind::uv;
  Vec2 scale_{1, 1}, delta_;
  Vec3 v1_, v2_;
  Transform world_from_texture_;
};

}  // namespace dspm
