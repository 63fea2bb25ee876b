// Radiance from all directions, constant within each pixel of an image; directions are sampled in exact proportion to
// its luminance.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/math/sphere_mapping.h"
#include "dspm/math/sampling.h"
#include "dspm/math/vec.h"

namespace dspm {

class EnvironmentMap {
 public:
  struct Sample {
    Vec3 direction;
    Rgb radiance;
    float pdf_w;
  };

  /// All values of the image must be finite and non-negative.
  EnvironmentMap(Image image, SphereMapping mapping);

  Rgb radiance(const Vec3& direction) const { return image_.pixels[pixel_at(direction)]; }
  float pdf_w(const Vec3& direction) const;
  /// Only if the map is not black.
  Sample sample(Vec2 u) const;
  /// The u for which sample(u) has that direction.
  Vec2 sample_numbers(const Vec3& direction) const;
  friend bool operator==(const EnvironmentMap& a, const EnvironmentMap& b) {
    return a.mapping_ == b.mapping_ && a.image_ == b.image_;
  }
  /// The radiance, if it is the same in all directions and not black.
  std::optional<Rgb> constant() const {
    return image_.pixels.size() == 1 && !is_black() ? std::optional(image_.pixels[0]) : std::nullopt;
  }
  /// The larger number of pixels, across or down.
  int size() const { return std::max(image_.width, image_.height); }
  bool is_black() const { return !(rows_.total() > 0); }
  /// Radiance integrated over all directions.
  Rgb fluence() const;
  /// For a surface that faces +z: the integral of luminance times cosine over the directions above.
  float illuminance() const;

 private:
  std::size_t pixel_at(const Vec3& direction) const;
  float solid_angle(int row) const;  // of one of its pixels
  float pdf_w(int x, int y) const;
  Vec3 direction_in(int x, int y, Vec2 u) const;
  std::vector<Distribution1D> distributions_within_rows() const;
  Distribution1D distribution_of_rows() const;

  Image image_;
  SphereMapping mapping_;
  std::vector<Distribution1D> columns_;  // of each row
  Distribution1D rows_;
};

}  // namespace dspm
