// Warps of uniform numbers in [0, 1) to directions and points, each with its density, and piecewise-constant
// distributions. Directions are around +z.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/math/bins.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// Uniform on the unit disk; neighbours stay neighbours. Density 1 / pi. [Shirley and Chiu 1997]
Vec2 concentric_disk(Vec2 u);
/// Returns the u with concentric_disk(u) = p.
Vec2 concentric_disk_numbers(Vec2 p);

/// Density cos / pi per solid angle.
Vec3 cosine_hemisphere(Vec2 u);
inline float cosine_hemisphere_pdf_w(float cos_theta) { return std::max(cos_theta, 0.f) / kPi; }

Vec3 uniform_sphere(Vec2 u);
/// Returns the u with uniform_sphere(u) = w.
Vec2 uniform_sphere_numbers(const Vec3& w);
inline constexpr float kUniformSpherePdfW = 1 / (4 * kPi);

/// The azimuth of w as a fraction of a turn, in [0, 1).
float turn_of(const Vec3& w);

Vec3 uniform_hemisphere(Vec2 u);
inline constexpr float kUniformHemispherePdfW = 1 / (2 * kPi);

/// Directions around z within the angle of cosine cos_max. Takes 1 - cos_max because in a narrow cone cos_max itself
/// has no digits left.
Vec3 uniform_cone(Vec2 u, float one_minus_cos_max);
inline float uniform_cone_pdf_w(float one_minus_cos_max) { return 1 / (2 * kPi * one_minus_cos_max); }

/// Barycentric coordinates (b1, b2) of a point uniform on a triangle's area; b0 = 1 - b1 - b2. [Heitz 2019]
Vec2 uniform_triangle(Vec2 u);
/// Returns the u with uniform_triangle(u) = b.
Vec2 uniform_triangle_numbers(Vec2 b);

/// n weights as a density over [0, 1) that is constant on each of n equal bins, and as a choice among n items.
class Distribution1D {
 public:
  using Choice = BinChoice;

  /// Needs at least one weight; all must be finite and non-negative. If all are zero, they count as equal.
  explicit Distribution1D(std::span<const float> weights);

  Choice choose(float u) const { return choose_bin(bins(), std::span<const std::uint32_t>(cutpoints_), u); }
  float probability(int index) const { return probability_of(bins(), index); }
  /// Returns the u for which choose(u) returns that index and rest.
  float number(int index, float rest) const { return bin_number(bins(), index, rest); }
  int size() const { return static_cast<int>(bins_.size()) - 1; }
  float total() const { return total_; }  // the sum of the weights
  /// Returns one bin more than there are weights; the last begins at 1.
  std::span<const Bin> bins() const { return bins_; }

 private:
  std::vector<Bin> bins_;
  std::vector<std::uint32_t> cutpoints_;
  float total_;
};

}  // namespace dspm
