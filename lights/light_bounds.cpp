#include "dspm/lights/light_bounds.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"

namespace dspm {
namespace {

/// Returns v turned about the unit vector k. [Rodrigues]
Vec3 turned(const Vec3& v, const Vec3& k, double angle) {
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  return v * c + cross(k, v) * s + k * (dot(k, v) * (1 - c));
}

}  // namespace

void LightBounds::add(const LightBounds& other) {
  if (other.box.empty()) return;
  if (box.empty()) return static_cast<void>(*this = other);
  box.add(other.box);
  reach = std::max(reach, other.reach), two_sided |= other.two_sided;
  // The cone around two cones lies in the plane of their axes. [Barequet and Elber 2005]
  const LightBounds wide = spread >= other.spread ? *this : other, narrow = spread >= other.spread ? other : *this;
  const float between = rounded::acos(std::clamp(dot(wide.axis, narrow.axis), -1.f, 1.f));
  axis = wide.axis, spread = wide.spread;
  if (std::min(between + narrow.spread, kPi) <= wide.spread) return;
  const float outer = 0.5f * (wide.spread + between + narrow.spread);
  const Vec3 normal = cross(wide.axis, narrow.axis);
  const float sine = length(normal);
  if (outer >= kPi || !(sine > 1e-6f)) return static_cast<void>(spread = between > 1 || outer >= kPi ? kPi : outer);
  axis = normalize(turned(wide.axis, normal / sine, static_cast<double>(outer - wide.spread)));
  spread = outer;
}

double LightBounds::solid_angle() const {
  const auto from = static_cast<double>(spread);
  const double to = std::min(from + static_cast<double>(reach), static_cast<double>(kPi));
  const double c = std::cos(from), s = std::sin(from);
  const double whole = 4 * static_cast<double>(kPi);
  const double one = whole / 2 * (1 - c) + whole / 8 * (2 * to * s - std::cos(from - 2 * to) - 2 * from * s + c);
  return std::min(two_sided ? 2 * one : one, whole);
}

}  // namespace dspm
