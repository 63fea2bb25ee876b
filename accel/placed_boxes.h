// The boxes of a placed shape in the world, with the margins that a tree needs.
#pragma once

#include <span>

#include "dspm/accel/box_ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

/// Holds what is the same for all primitives of a shape, of which hair has millions.
class PlacedBoxes {
 public:
  explicit PlacedBoxes(const PlacedShape& placed)
      : placed_(&placed),
        margins_(stretch_of(placed.to_world)),
        origin_(max_component(abs(placed.to_world.point({})))) {}

  /// The margins that a ray's origin needs for them, see Tree::margins.
  float margins() const { return margins_; }
  Bounds3 of_primitive(int primitive) const {
    const Bounds3 box = with_margin(placed_->shape->bounds(primitive));
    return of(std::span(&box, 1));
  }
  /// Returns the box of boxes in the shape's space.
  Bounds3 of(std::span<const Bounds3> outline) const {
    Bounds3 world;
    for (const Bounds3& part : outline) world.add(placed_->in_object_space() ? placed_->to_world.bounds(part) : part);
    return widened(world, margins_ * kBoxMargin * (largest_coordinate(world) + origin_));
  }

 private:
  // Norm of a linear map, with vectors measured by their largest component.
  template <class Map>
  static float norm(const Map& map) {
    return max_component(abs(map(Vec3{1, 0, 0})) + abs(map(Vec3{0, 1, 0})) + abs(map(Vec3{0, 0, 1})));
  }

  // How much larger a rounding error in object space, or on the way there, can be in world space than one made there: the
  // condition number of the transform. Doubled, since the margins of object space come on top of it.
  static float stretch_of(const Transform& t) {
    return 2 * norm([&](const Vec3& v) { return t.vector(v); }) *
           norm([&](const Vec3& v) { return t.inverse_vector(v); });
  }

  const PlacedShape* placed_;
  float margins_, origin_;
};

}  // namespace dspm
