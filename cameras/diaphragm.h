// A lens' stop lets light through a circle, or a shape that is seen in every highlight out of focus.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/image/image.h"

namespace dspm {

class Diaphragm {
 public:
  /// Makes a circle.
  Diaphragm() = default;
  /// Returns one of pbrt's shapes: "gaussian", "square", "pentagon", "star"; nullopt for other names.
  static std::optional<Diaphragm> named(std::string_view name);
  /// Makes a shape of the mean of a picture's red, green and blue, whose upper edge is at y = 1. Throws
  /// std::runtime_error with a sentence if it lets nothing through, or is negative or not finite somewhere.
  static Diaphragm of(const Image& picture);

  /// Returns the share of light that passes at a place of the stop, whose aperture is a circle of radius 1. Shapes are
  /// scaled to let as much light through in all as the circle does, so this may be above 1.
  float share(Vec2 place) const;
  /// The radius of the circle outside of which it is dark.
  float reach() const;
  friend bool operator==(const Diaphragm&, const Diaphragm&) = default;

 private:
  enum class Kind { circle, gaussian, square, polygon, picture };

  bool is_in_polygon(Vec2 place) const;
  float of_picture(Vec2 place) const;

  Kind kind_ = Kind::circle;
  float scale_ = 1;
  std::vector<Vec2> corners_;  // of a polygon
  int width_ = 0, height_ = 0;
  std::vector<float> values_;  // of the picture
};

}  // namespace dspm
