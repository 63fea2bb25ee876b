// The light that a projector sends through the image on a screen in front of it: radiant intensity by direction,
// bilinear between the centres of pixels. The screen lies in the plane z = 1, its image upright for an eye at the
// origin with +x to the right and +y up.
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/distribution.h"
#include "dspm/base/math/vec.h"
#include "dspm/image/image.h"
#include "dspm/lights/emission_picture.h"

namespace dspm {

class ScreenImage {
 public:
  struct Sample {
    Vec3 direction;
    Rgb radiance;
    float pdf_w;
  };

  /// Takes an image whose shorter axis covers `fov` degrees. All values must be finite and non-negative.
  ScreenImage(Image image, float fov);

  Rgb radiance(const Vec3& direction) const;
  float pdf_w(const Vec3& direction) const;
  /// Draws a direction; the image must not be black.
  Sample sample(Vec2 u) const;
  /// Returns the u for which sample(u) has that direction, if there is one.
  Vec2 sample_numbers(const Vec3& direction) const;
  bool is_black() const { return !(rows_.total() > 0); }
  /// The radiant intensity integrated over all directions.
  Rgb fluence() const;
  friend bool operator==(const ScreenImage& a, const ScreenImage& b) {
    return a.half_ == b.half_ && a.picture_ == b.picture_;
  }

 private:
  /// A place in a cell. Pixels are cut into an even number of cells, so that their solid angle varies little within one
  /// and the image is bilinear in it.
  struct Place {
    int x, y;  // of the cell
    Vec2 rest;
  };

  struct Cell;

  std::optional<Place> place_of(const Vec3& direction) const;
  Cell cell(int x, int y) const;
  /// Returns the place on the whole screen.
  Vec2 place_in(int x, int y, Vec2 rest) const;
  Rgb at(Vec2 place) const { return picture_.at({place.x, 1 - place.y}); }
  float solid_angle(int x, int y) const;
  float pdf_w(const Place& place, const Cell& cell, float cosine) const;
  std::vector<Distribution1D> distributions_within_rows() const;
  Distribution1D distribution_of_rows() const;

  Vec2 half_;           // of the screen's width and height
  int width_, height_;  // in cells
  EmissionPicture picture_;
  std::vector<Distribution1D> columns_;  // of each row
  Distribution1D rows_;
};

}  // namespace dspm
