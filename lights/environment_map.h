// Radiance from all directions: a picture around the sphere, bilinear between the centres of its pixels and continuous
// everywhere. Directions are sampled in exact proportion to its luminance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/bins.h"
#include "dspm/base/math/distribution.h"
#include "dspm/base/math/sphere_mapping.h"
#include "dspm/base/math/vec.h"
#include "dspm/image/image.h"
#include "dspm/lights/sphere_band.h"

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
  /// Draws a direction; the map must not be black.
  Sample sample(Vec2 u) const;
  /// Brings what sample(u) will read into the cache.
  void prefetch(Vec2 u) const;
  /// Returns the u for which sample(u) has that direction.
  Vec2 sample_numbers(const Vec3& direction) const;
  friend bool operator==(const EnvironmentMap& a, const EnvironmentMap& b);
  /// The radiance, if it is the same in all directions and not black.
  std::optional<Rgb> constant() const {
    return width_ == 1 && height_ == 1 && !is_black() ? std::optional(nodes_.front().radiance) : std::nullopt;
  }
  /// The larger number of pixels, across or down.
  int size() const { return std::max(width_, height_); }
  bool is_black() const { return !(rows_.total() > 0); }
  /// Radiance integrated over all directions.
  Rgb fluence() const;
  /// Returns the integral of luminance times cosine over the directions above a surface that faces +z.
  float illuminance() const;

 private:
  /// The centre of a pixel, or a place at the picture's rim: each row and column has two more nodes than pixels. Four
  /// are the corners of a cell, within which radiance is bilinear. A row's cells are the bins of the luminance in them;
  /// a cell is stored with its upper left corner. What a sample needs lies together: memory is what it waits for.
  struct Node : Bin {
    Rgb radiance;
  };
  struct Place {
    int x, y;  // of the cell
    Vec2 rest;
  };
  struct Cell;

  Place cell_at(const Vec3& direction) const;
  Cell cell(int x, int y) const;
  float pdf_w(const Place& at, const Cell& cell) const;
  Vec3 direction_at(const Place& at) const;
  void place_nodes(const Image& image);
  Distribution1D distribution_of_rows();
  std::span<const Node> row(int y) const {
    const auto length = static_cast<std::size_t>(width_) + 2;
    return std::span(nodes_).subspan(static_cast<std::size_t>(y) * length, length);
  }
  const Rgb& at_node(int x, int y) const { return row(y)[static_cast<std::size_t>(x)].radiance; }

  std::span<const std::uint16_t> cutpoints_of_row(int y) const {
    const std::size_t length = cutpoint_count(static_cast<std::size_t>(width_) + 1);
    return std::span(cutpoints_).subspan(static_cast<std::size_t>(y) * length, length);
  }

  int width_, height_;  // in pixels
  SphereMapping mapping_;
  std::vector<Node> nodes_;  // row by row
  std::vector<SphereBand> bands_;
  std::vector<std::uint16_t> cutpoints_;
  Distribution1D rows_;  // of cells
};

}  // namespace dspm
