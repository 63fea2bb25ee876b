// Radiance from all directions, constant within each pixel of an image; directions are sampled in exact proportion to
// its luminance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/math/bins.h"
#include "dspm/math/sampling.h"
#include "dspm/math/sphere_mapping.h"
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
  EnvironmentMap(const Image& image, SphereMapping mapping);

  Rgb radiance(const Vec3& direction) const;
  float pdf_w(const Vec3& direction) const;
  /// Only if the map is not black.
  Sample sample(Vec2 u) const;
  /// Brings what sample(u) will read into the cache.
  void prefetch(Vec2 u) const;
  /// The u for which sample(u) has that direction.
  Vec2 sample_numbers(const Vec3& direction) const;
  friend bool operator==(const EnvironmentMap& a, const EnvironmentMap& b);
  /// The radiance, if it is the same in all directions and not black.
  std::optional<Rgb> constant() const {
    return width_ == 1 && height_ == 1 && !is_black() ? std::optional(radiance(0, 0)) : std::nullopt;
  }
  /// The larger number of pixels, across or down.
  int size() const { return std::max(width_, height_); }
  bool is_black() const { return !(rows_.total() > 0); }
  /// Radiance integrated over all directions.
  Rgb fluence() const;
  /// For a surface that faces +z: the integral of luminance times cosine over the directions above.
  float illuminance() const;

 private:
  /// A row's pixels are the bins of its luminance. What a sample needs lies together: memory is what it waits for.
  struct Pixel : Bin {
    Rgb radiance;
  };
  struct Place {
    int x, y;
    Vec2 rest;  // within the pixel
  };

  Place pixel_at(const Vec3& direction) const;
  const Rgb& radiance(int x, int y) const { return row(y)[static_cast<std::size_t>(x)].radiance; }
  float solid_angle(int row) const;  // of one of its pixels
  float pdf_w(int x, int y) const;
  Vec3 direction_in(int x, int y, Vec2 u) const;
  Distribution1D distribution_of_rows(const Image& image);
  /// One more than the image has: the end of the last bin.
  std::span<const Pixel> row(int y) const {
    const auto length = static_cast<std::size_t>(width_) + 1;
    return std::span(pixels_).subspan(static_cast<std::size_t>(y) * length, length);
  }

  std::span<const std::uint16_t> cutpoints_of_row(int y) const {
    const std::size_t length = cutpoint_count(static_cast<std::size_t>(width_));
    return std::span(cutpoints_).subspan(static_cast<std::size_t>(y) * length, length);
  }

  int width_, height_;
  SphereMapping mapping_;
  std::vector<Pixel> pixels_;  // row by row
  std::vector<std::uint16_t> cutpoints_;
  Distribution1D rows_;
};

}  // namespace dspm
