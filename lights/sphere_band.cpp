#include "dspm/lights/sphere_band.h"

#include <algorithm>
#include <cmath>

#include "dspm/lights/linear_density.h"

namespace dspm {

SphereBand::SphereBand(SphereMapping mapping, double top, double bottom)
    : mapping_(mapping),
      top_(mapping == SphereMapping::equal_area ? top : M_PI * top),
      height_(mapping == SphereMapping::equal_area ? bottom - top : M_PI * (bottom - top)),
      upper_(static_cast<float>(to(1, 1, 0))),
      lower_(static_cast<float>(to(1, 0, 1))) {}

// Of latitude and longitude, 2 pi times the integral of f(angle) sin(angle): by parts, as f' does not vary.
double SphereBand::to(double t, double a, double b) const {
  const double end = a + (b - a) * t;
  if (mapping_ == SphereMapping::equal_area) return 4 * M_PI * height_ * t * (a + end) / 2;
  const double slope = (b - a) / height_, from = angle(0), here = angle(t);
  return 2 * M_PI * (a * std::cos(from) - end * std::cos(here) + slope * (std::sin(here) - std::sin(from)));
}

// Of latitude and longitude by Newton's method, kept within what is known to hold the answer.
float SphereBand::sample(float u, float a, float b) const {
  if (mapping_ == SphereMapping::equal_area) return sample_linear(u, a, b);
  if (!(a + b > 0)) a = b = 1;
  const double whole = to(1, a, b), sought = static_cast<double>(u) * whole;
  const auto density = [&](double t) { return 2 * M_PI * height_ * (a + (b - a) * t) * std::sin(angle(t)); };
  double low = 0, high = 1;
  double t = static_cast<double>(
      sample_linear(u, a * static_cast<float>(std::sin(angle(0))), b * static_cast<float>(std::sin(angle(1)))));
  for (int step = 0; step < 32; ++step) {
    const double beyond = to(t, a, b) - sought;
    if (std::abs(beyond) <= 1e-7 * whole) break;
    (beyond > 0 ? high : low) = t;
    const double next = t - beyond / density(t);
    t = next > low && next < high ? next : (low + high) / 2;
  }
  return static_cast<float>(t);
}

float SphereBand::number(float t, float a, float b) const {
  if (mapping_ == SphereMapping::equal_area) return linear_number(t, a, b);
  if (!(a + b > 0)) a = b = 1;
  return std::clamp(static_cast<float>(to(t, a, b) / to(1, a, b)), 0.f, 1.f);
}

}  // namespace dspm
