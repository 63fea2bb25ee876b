// Maps a point on a surface to the plane in which pictures and checkerboards lie, or to the space in which noise and
// cubes do. A footprint is carried along: the changes of the coordinates along its two axes.
//
//   | mapping                              | "uv"     | or spherical, cylindrical, planar                         |
//   | uvset                                | 1        | of uv: 2 takes a mesh's second texture coordinates        |
//   | uscale, vscale, udelta, vdelta       | 1, 1, 0, 0 | of uv: s = uscale u + udelta; planar takes the deltas too |
//   | rotation                             | 0        | of uv: degrees from u towards v, after the scale and before the
//   |                                      |          | delta                                                     |
//   | v1, v2                               | x, y     | of planar: s = v1 . p + udelta, t = v2 . p + vdelta       |
//
// All but uv use the point in the texture's own space: the transform in force where the texture was defined.
#pragma once

#include <optional>

#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plain_mapping.h"
#include "dspm/textures/texture.h"

namespace dspm {

/// A place in the plane of a picture.
struct TextureCoordinates {
  Vec2 st;
  Vec2 dstdx{}, dstdy{};  // the footprint's axes; zero for a point
};

class TextureMapping {
 public:
  static TextureMapping read(ParamReader& reader, const Transform& world_from_texture);

  Vec2 at(const TexturePoint& point) const;
  TextureCoordinates map(const TexturePoint& point) const;

  /// Returns the mapping of points as a plain value; nullopt if it takes more of them than one has.
  std::optional<PlainMapping> plain() const { return second_uv_ ? std::nullopt : std::optional(plain_); }

 private:
  bool takes_second(const TexturePoint& point) const { return second_uv_ && point.vertices.data != nullptr; }
  /// Returns the change of the coordinates along the axis `dp` of a footprint, to first order.
  Vec2 change(const TexturePoint& point, const Vec3& dp) const;

  PlainMapping plain_;
  bool second_uv_ = false;
};

/// A place in the texture's own space.
struct SpaceCoordinates {
  Vec3 p;
  Vec3 dpdx, dpdy;  // the footprint's axes; zero for a point
};
inline SpaceCoordinates in_own_space(const Transform& world_from_texture, const TexturePoint& at) {
  return {world_from_texture.inverse_point(at.p), world_from_texture.inverse_vector(at.dpdx),
          world_from_texture.inverse_vector(at.dpdy)};
}

}  // namespace dspm
