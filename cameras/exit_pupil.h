// The part of a lens' rear through which light reaches a place on the film: it is small, and away from the axis if that
// place is at the film's edge. Rays start through a box around it. [Pharr, Jakob, Humphreys, Physically Based
// Rendering, 3rd ed., 6.4.5]
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/cameras/lens_system.h"

namespace dspm {

class ExitPupil {
 public:
  /// Finds the pupil for places on the film up to that radius around the axis. Boxes are those of a round stop, as they
  /// turn with the place around the axis and shapes do not.
  ExitPupil(const LensSystem& lens, float film_radius);

  struct Sample {
    Vec3 p;      // in the plane of the rear surface's vertex
    float area;  // of the box: p is uniform on it
  };
  /// Returns nullopt if no light comes there.
  std::optional<Sample> sample(Vec2 film, Vec2 u) const;

 private:
  /// A box for a place on the film's +x axis: the pupil is then symmetrical in y.
  struct Box {
    float left = kInfinity, right = -kInfinity, half_height = 0;

    bool empty() const { return !(left < right); }
    void add(const Box& other);
  };
  static Box found_within(const LensSystem& lens, float film_x, const Box& box, int columns);
  static Box found_beside(const LensSystem& lens, float film_x, const Box& neighbour);
  static Box found_anywhere(const LensSystem& lens, float film_x, int most_columns);
  static Box bound(const LensSystem& lens, float film_x, const Box* neighbour);

  float rear_z_, ring_width_;
  std::vector<Box> rings_;
};

}  // namespace dspm
