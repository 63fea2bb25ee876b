#include "dspm/media/medium_box.h"

namespace dspm {

MediumBox::MediumBox(ParamReader& reader, const Transform& to_world) : to_world_(to_world) {
  box_.add(reader.point("p0", {0, 0, 0}, "medium space", "a corner of the box that it fills"));
  box_.add(reader.point("p1", {1, 1, 1}, "medium space", "the opposite corner"));
  const Vec3 size = box_.extent();
  if (!(size.x > 0 && size.y > 0 && size.z > 0))
    reader.error("p1", "\"p0\" and \"p1\" of " + reader.subject() + " are corners of a box without volume");
}

Vec3 MediumBox::place_of(const Vec3& p) const { return place_in_box(to_world_.inverse_point(p)); }

Bounds3 MediumBox::places_of(const Bounds3& box) const {
  constexpr float kRounding = 1e-4f;
  const Bounds3 in_medium = to_world_.inverse_bounds(box);
  const Vec3 more{kRounding, kRounding, kRounding};
  return {place_in_box(in_medium.low) - more, place_in_box(in_medium.high) + more};
}

Vec3 MediumBox::place_in_box(const Vec3& p) const {
  const Vec3 from_corner = p - box_.low, size = box_.extent();
  return {from_corner.x / size.x, from_corner.y / size.y, from_corner.z / size.z};
}

}  // namespace dspm
