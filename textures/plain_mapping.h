// The mapping from a surface to the plane of a picture as a plain value, which a device can have: see mapping.h.
#pragma once

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// The place where a plain texture is looked up: a point, without a footprint.
struct PlainPlace {
  Vec3 p;  // in the world
  Vec2 uv;
};

struct PlainMapping {
  enum class Kind { uv, spherical, cylindrical, planar };

  Kind kind = Kind::uv;
  Vec2 scale{1, 1}, delta;
  Vec2 along_u{1, 0};  // where u leads to
  Vec3 v1, v2;
  Transform world_from_texture;

  constexpr Vec2 at(const PlainPlace& place) const {
    if (kind == Kind::uv) {
      const Vec2 st = turned_uv(place.uv);
      return {st.x + delta.x, st.y + delta.y};
    }
    return at_own(own(place));
  }
  /// Returns the place in the texture's own space.
  constexpr Vec3 own(const PlainPlace& place) const { return world_from_texture.inverse_point(place.p); }

  constexpr Vec2 turned_uv(Vec2 uv) const {
    const Vec2 scaled{scale.x * uv.x, scale.y * uv.y};
    if (along_u.y == 0 && along_u.x == 1) return scaled;
    return {along_u.x * scaled.x - along_u.y * scaled.y, along_u.y * scaled.x + along_u.x * scaled.y};
  }

 private:
  constexpr Vec2 at_own(const Vec3& p) const {
    if (kind == Kind::spherical) return spherical(p);
    if (kind == Kind::cylindrical) return cylindrical(p);
    return {dot(p, v1) + delta.x, dot(p, v2) + delta.y};
  }
  /// Returns the angle around z as a fraction of a turn from x, in [0, 1).
  static constexpr float turn(const Vec3& p) {
    const float fraction = rounded::atan2(p.y, p.x) / (2 * kPi);
    return fraction < 0 ? fraction + 1 : fraction;
  }
  /// Returns s from the pole at +z to the other, and t around the axis, as in pbrt.
  static constexpr Vec2 spherical(const Vec3& p) {
    return {rounded::atan2(rounded::hypot(p.x, p.y), p.z) / kPi, turn(p)};
  }
  /// Returns s, which is 0 at -x, as in pbrt, and t, which is the height.
  static constexpr Vec2 cylindrical(const Vec3& p) { return {0.5f + rounded::atan2(p.y, p.x) / (2 * kPi), p.z}; }
};

}  // namespace dspm
