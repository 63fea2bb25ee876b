// A map of where light comes from in the hemisphere above a window, as means over cells between two angles, so that
// what a point sees through the window is a rectangle of cells: directions are sampled within it in proportion to the
// means. [Bitterli, Novak, Jarosz 2015, Portal-Masked Environment Map Sampling]
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/distribution.h"
#include "dspm/base/math/vec.h"
#include "dspm/image/image.h"

namespace dspm {

/// Directions are in the window's space: z > 0. Their place is in the unit square: the angles of (x, z) and (y, z) to
/// z, from -90 to 90 degrees.
class WindowMap {
 public:
  struct Part {  // of the unit square
    Vec2 low, high;
    bool contains(Vec2 place) const {
      return place.x >= low.x && place.x <= high.x && place.y >= low.y && place.y <= high.y;
    }
  };
  struct Sample {
    Vec3 direction;
    float pdf_w;
  };

  /// Averages `radiance(direction)` over each of `side` x `side` cells by `samples` x `samples` directions.
  template <class Radiance>
  WindowMap(int side, int samples, Radiance&& radiance) : image_(side, side) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) image_.at(x, y) = mean_in_cell(x, y, samples, radiance);
    sum();
  }

  static Vec3 direction_at(Vec2 place);
  static Vec2 place_of(const Vec3& direction);

  bool is_black() const { return !(rows_.total() > 0); }
  /// Integrates over the hemisphere, times the cosine to z: the irradiance on the window.
  Rgb irradiance() const;

  /// Draws a direction within a part, by the cells' luminance. Returns nullopt if it is black there.
  std::optional<Sample> sample(const Part& part, Vec2 u) const;
  float pdf_w(const Part& part, Vec2 place) const;

  /// Draws a direction over the hemisphere, by luminance times the cosine to z of the cells. The map must not be black.
  Sample sample_crossing(Vec2 u) const;
  float crossing_pdf_w(Vec2 place) const;
  /// Returns the u for which sample_crossing(u) has that place.
  Vec2 crossing_numbers(Vec2 place) const;

 private:
  template <class Radiance>
  Rgb mean_in_cell(int x, int y, int samples, Radiance&& radiance) const {
    Rgb sum;
    float weights = 0;
    for (int i = 0; i < samples * samples; ++i) {
      const float dx = (static_cast<float>(i % samples) + 0.5f) / static_cast<float>(samples),
                  dy = (static_cast<float>(i / samples) + 0.5f) / static_cast<float>(samples);
      const Vec2 place{(static_cast<float>(x) + dx) / side(), (static_cast<float>(y) + dy) / side()};
      const Vec3 direction = direction_at(place);
      const float weight = solid_angle_per_place(direction);
      sum += radiance(direction) * weight, weights += weight;
    }
    return sum / weights;
  }

  float side() const { return static_cast<float>(image_.width); }
  int cell(float place) const;
  void sum();
  float sampled_light(int x, int y) const;
  static float solid_angle_per_place(const Vec3& direction);
  /// Returns the luminance integrated over [0, x] x [0, y] of the square; x and y are in cells, not in places.
  double sum_to(double x, double y) const;
  double sum_in(double x0, double y0, double x1, double y1) const;
  double weight(int x, int y) const { return sum_in(x, y, x + 1, y + 1); }
  float density(int x, int y, double whole, const Vec3& direction) const;

  Image image_;
  std::vector<double> sums_;             // of luminance times solid angle, over all cells up to a corner
  std::vector<Distribution1D> columns_;  // by luminance times projected solid angle, of each row
  Distribution1D rows_{std::vector<float>{0}};
};

}  // namespace dspm
