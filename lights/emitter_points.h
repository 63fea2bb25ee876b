// Points of a shape that emits light, drawn in proportion to area, or to area times a brightness that varies over the
// surface. Densities are by area in the world.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/distribution.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/emitter_sight.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

class EmitterPoints {
 public:
  /// The light that leaves the surface at a point, relative to what the whole would emit; null if it is 1 everywhere.
  using Brightness = std::function<Rgb(const SurfacePoint&)>;

  /// When brightness is measured all over the surface. Of an animated texture there are many states, most of which are
  /// never drawn from: deferred, a sixteenth of the samples estimate the total, and the first draw takes the others.
  enum class Measured { at_once, deferred };

  /// `placed`, and what `brightness` needs, must outlive this.
  EmitterPoints(const PlacedShape& placed, Brightness brightness, Measured when, bool two_sided = false);

  struct Start : AreaSample {
    int primitive;
  };
  Start sample(Vec2 u) const;
  /// Returns the density of a point of that primitive, whose normal is ng.
  float pdf_a(int primitive, const Vec3& p, const Vec3& ng) const;

  /// A point drawn for the light that it sends to another.
  struct Seen {
    SurfacePoint point;
    int primitive;
    float pdf_w;
  };
  Seen sample_seen(const Vec3& from, Vec2 u) const;
  /// Returns the density of sample_seen(from) by solid angle at a point of that primitive, whose normal is ng.
  float seen_pdf_w(const Vec3& from, int primitive, const Vec3& p, const Vec3& ng) const;

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

  struct Tables {
    std::vector<Cells> cells;  // by primitive; empty: uniform
    std::optional<Distribution1D> primitives;
    std::optional<EmitterSight> sight;
  };

  enum class Threads { all, this_one };

  int cells_along_side() const;
  /// By primitive, row by row.
  std::vector<std::vector<Rgb>> measure(int samples_along_cell, Threads threads) const;
  std::vector<Rgb> brightness_of_cells(int primitive, int samples_along_cell) const;
  Rgb total_of(const std::vector<std::vector<Rgb>>& cells) const;
  void make_tables(const std::vector<std::vector<Rgb>>& cells) const;
  const Tables& tables() const;
  void choose_by(std::span<const float> weights) const;
  /// Returns the point of a primitive that is chosen with that probability.
  Start point_of(int primitive, float probability, Vec2 u) const;
  /// Returns the density of a point of the primitive, if this is chosen with that probability.
  float pdf_a_of(int primitive, float probability, const Vec3& p, const Vec3& ng) const;
  const Cells* cells_of(int primitive) const {
    const std::vector<Cells>& cells = tables().cells;
    return cells.empty() ? nullptr : &cells[static_cast<std::size_t>(primitive)];
  }

  const PlacedShape& placed_;
  Brightness brightness_;
  bool two_sided_;
  std::vector<float> areas_;  // by primitive
  double area_ = 0;
  Rgb total_;
  mutable std::once_flag made_;
  mutable Tables tables_;
};

}  // namespace dspm
