// Points of a shape that emits light, drawn in proportion to area, or to area times a brightness that varies over the
// surface. Densities are by area in the world.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/math/sampling.h"
#include "dspm/math/vec.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

class EmitterPoints {
 public:
  /// What leaves the surface at a point, relative to what the whole would emit; null if it is 1 everywhere.
  using Brightness = std::function<Rgb(const SurfacePoint&)>;

  /// `placed` must outlive this object.
  EmitterPoints(const PlacedShape& placed, const Brightness& brightness);

  struct Start : AreaSample {
    int primitive;
  };
  Start sample(Vec2 u) const;
  /// Returns the density of a point of that primitive, whose normal is ng.
  float pdf_a(int primitive, const Vec3& p, const Vec3& ng) const;
  /// Returns the u for which sample(u) gives that point, up to rounding; nullopt if it is not known.
  std::optional<Vec2> numbers(int primitive, const Vec3& p) const;
  bool empty() const { return !(area_ > 0); }
  /// The brightness integrated over the area.
  Rgb total() const { return total_; }

 private:
  /// The numbers of a primitive's points as an n x n table of cells, by brightness.
  struct Cells {
    Distribution1D rows;
    std::vector<Distribution1D> columns;  // of each row
  };

  void measure(const Brightness& brightness, const std::vector<float>& areas, std::vector<float>& weights);
  std::vector<Rgb> brightness_of_cells(const Brightness& brightness, int primitive, int side) const;
  const Cells* cells_of(int primitive) const {
    return cells_.empty() ? nullptr : &cells_[static_cast<std::size_t>(primitive)];
  }

  const PlacedShape& placed_;
  std::vector<Cells> cells_;  // by primitive; empty: uniform
  std::optional<Distribution1D> primitives_;
  double area_ = 0;
  Rgb total_;
};

}  // namespace dspm
