// Solid angles of rectangles in the plane z = 1, as seen from the origin.
#pragma once

#include <cmath>

namespace dspm {

/// Returns the solid angle of the rectangle from (0, 0) to (x, y), with the sign of x y.
inline double solid_angle_to(double x, double y) { return std::atan2(x * y, std::sqrt(1 + x * x + y * y)); }

/// Returns it with directions weighted by their cosine to the z axis: pi times the form factor of a corner. [Howell,
/// Menguc, A Catalog of Radiation Heat Transfer Configuration Factors, B-4]
inline double projected_solid_angle_to(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return 0.5 * (x / a * std::atan(y / a) + y / b * std::atan(x / b));
}

/// Returns the solid angle of the rectangle between two corners, from what `to` says of those that begin at (0, 0).
template <class To>
double between_corners(double x0, double y0, double x1, double y1, To&& to) {
  return to(x1, y1) - to(x0, y1) - to(x1, y0) + to(x0, y0);
}

}  // namespace dspm
