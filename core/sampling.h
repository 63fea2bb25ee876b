// Warps of uniform numbers in [0, 1) to directions and points, each next to its density, and piecewise-constant
// distributions. Directions are around +z.
#pragma once

#include <span>
#include <vector>

#include "core/vec.h"

namespace dspm {

/// Uniform on the unit disk, keeping neighbours neighbours; density 1 / pi. [Shirley and Chiu 1997]
Vec2 concentric_disk(Vec2 u);

/// Density cos / pi per solid angle.
Vec3 cosine_hemisphere(Vec2 u);
inline float cosine_hemisphere_pdf_w(float cos_theta) { return std::max(cos_theta, 0.f) / kPi; }

Vec3 uniform_sphere(Vec2 u);
inline constexpr float kUniformSpherePdfW = 1 / (4 * kPi);

Vec3 uniform_hemisphere(Vec2 u);
inline constexpr float kUniformHemispherePdfW = 1 / (2 * kPi);

/// Directions within the angle of cosine `cos_max` around z. `one_minus_cos_max` is asked for because cos_max itself
/// has no digits left where the cone is narrow.
Vec3 uniform_cone(Vec2 u, float one_minus_cos_max);
inline float uniform_cone_pdf_w(float one_minus_cos_max) { return 1 / (2 * kPi * one_minus_cos_max); }

/// Barycentric coordinates (b1, b2) of a point uniform on a triangle's area; b0 = 1 - b1 - b2. [Heitz 2019]
Vec2 uniform_triangle(Vec2 u);

/// n weights as a density over [0, 1) that is constant on each of n equal bins, and as the choice of one of n things.
class Distribution1D {
 public:
  struct Choice {
    int index;
    float probability;  // of this index
    float rest;         // in [0, 1): uniform again, to be used up elsewhere
  };

  /// Weights are finite and not negative; where all are zero, all are alike. There is at least one.
  explicit Distribution1D(std::span<const float> weights);

  Choice choose(float u) const;
  float probability(int index) const;
  int size() const { return static_cast<int>(cdf_.size()) - 1; }
  float total() const { return total_; }  // the sum of the weights

 private:
  std::vector<float> cdf_;  // of n bins n + 1 values, from 0 to 1
  float total_;
};

}  // namespace dspm
