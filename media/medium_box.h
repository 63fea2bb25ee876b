// The box that a medium on a grid fills, in a space of its own.
#pragma once

#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"

namespace dspm {

class MediumBox {
 public:
  /// Reads "p0" and "p1".
  MediumBox(ParamReader& reader, const Transform& to_world);

  /// Returns where a point of the world is in the box: in [0, 1]^3 if it is inside.
  Vec3 place_of(const Vec3& p) const;
  /// Returns a box that contains the places of all points of a box of the world.
  Bounds3 places_of(const Bounds3& box) const;
  Vec3 point_of(const Vec3& p) const { return to_world_.inverse_point(p); }  // in the medium's space
  Bounds3 extent() const { return to_world_.bounds(box_); }

 private:
  Vec3 place_in_box(const Vec3& p) const;  // of medium space

  Transform to_world_;
  Bounds3 box_;
};

inline bool is_within_unit_box(const Vec3& place) {
  return place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1 && place.z >= 0 && place.z <= 1;
}

}  // namespace dspm
