#include "dspm/integrators/photons/near_light.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

/// Distances along a ray.
struct Part {
  double begin, end;
};

/// Returns the part of a line in a cone whose tip is at `tip`, of directions whose cosine to the axis is at least `cosine`, which
/// must be above 0. With p = o + t d - tip these are the t for which (p axis)^2 >= cosine^2 p^2 and p axis >= 0.
Part in_cone(const Ray& ray, const Vec3& tip, const Vec3& axis, double cosine) {
  constexpr double kNever = -1, kAlways = static_cast<double>(kInfinity);
  const Vec3 from_tip = ray.origin - tip;
  const double square = cosine * cosine, along = double{dot(ray.direction, axis)}, start = double{dot(from_tip, axis)};
  const double a = along * along - square, b = start * along - square * double{dot(from_tip, ray.direction)},
               c = start * start - square * double{length2(from_tip)};
  if (a == 0) return b == 0 ? Part{0, kNever} : b > 0 ? Part{-c / (2 * b), kAlways} : Part{-kAlways, -c / (2 * b)};
  const double root = std::sqrt(std::max(0., b * b - a * c));
  const double one = (-b - root) / a, other = (-b + root) / a, first = std::min(one, other),
               second = std::max(one, other);
  if (a > 0) return along > 0 ? Part{second, kAlways} : Part{-kAlways, first};
  return root > 0 && start + along * (first + second) / 2 > 0 ? Part{first, second} : Part{0, kNever};
}

}  // namespace

NearLight::NearLight(const Ray& ray, float begin, float end, const LightBounds& light) : begin_(begin), end_(end) {
  const Vec3 center = light.box.center();
  const float size = length(light.box.extent()) / 2, widest = light.spread + light.reach;
  if (size == 0 && !light.two_sided && widest < kPi / 2) {
    const Part lit = in_cone(ray, center, light.axis, std::cos(double{widest}));
    begin_ = std::max(begin_, static_cast<float>(lit.begin)), end_ = std::min(end_, static_cast<float>(lit.end));
  }
  closest_ = dot(center - ray.origin, ray.direction);
  distance_ = std::max(size, length(center - ray.at(closest_)));
  if (!(end_ > begin_) || !(distance_ > 0)) return;
  first_ = rounded::atan((begin_ - closest_) / distance_), last_ = rounded::atan((end_ - closest_) / distance_);
}

float NearLight::draw(float u) const {
  return std::clamp(closest_ + distance_ * rounded::tan(first_ + u * (last_ - first_)), begin_, end_);
}

float NearLight::density(float t) const {
  if (is_empty() || t < begin_ || t > end_) return 0;
  const float s = t - closest_;
  return distance_ / ((last_ - first_) * (distance_ * distance_ + s * s));
}

}  // namespace dspm
