// The surface of a disk, ring or sector as "disk" describes it (disk.cpp), for CPUs and GPUs.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/elementary.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/rounding.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/quadric.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class DiskSurface {
 public:
  constexpr DiskSurface(float height, float radius, float inner, const Sweep& sweep)
      : height_(height), r_(radius), inner_(inner), sweep_(sweep) {}

  constexpr Bounds3 bounds() const {
    const float r = r_ * (1 + gamma_bound(4));
    return {{-r, -r, height_}, {r, r, height_}};
  }

  constexpr std::optional<PrimitiveHit> intersect(const Ray& ray) const {
    const DoubleVec3 o = widen(ray.origin), d = widen(ray.direction);
    if (d.z == 0) return std::nullopt;
    const double t = (height_ - o.z) / d.z;
    return first_hit({{t, t}}, ray.t_max, [&](double root) { return parameters(o + d * root); });
  }

  template <std::derived_from<SurfaceGeometry> Point = SurfaceGeometry>
  constexpr Point surface_point(Vec2 uv) const {
    const auto [s, c] = elementary::sin_cos(sweep_.phi(uv.x));
    const double rho = r_ + uv.y * (double{inner_} - r_);
    Point point;
    point.p = narrow({rho * c, rho * s, height_});
    point.p_error = gamma_bound(2) * Vec3{std::abs(point.p.x), std::abs(point.p.y), 0};
    point.ng = point.ns = {0, 0, 1};
    point.dpdu = narrow(DoubleVec3{-s, c, 0} * (at_least(rho, kLeastSine * r_) * sweep_.phi_max()));
    point.dpdv = narrow(DoubleVec3{c, s, 0} * (double{inner_} - r_));
    point.uv = uv;
    return point;
  }

  constexpr float area() const {
    return static_cast<float>(0.5 * sweep_.phi_max() * (double{r_} - inner_) * (double{r_} + inner_));
  }

  // The area within a radius grows with its square.
  constexpr Vec2 sample_area(Vec2 u) const {
    const double inner2 = double{inner_} * inner_, outer2 = double{r_} * r_;
    return {u.x, v_of(elementary::sqrt(outer2 + u.y * (inner2 - outer2)))};
  }
  constexpr std::optional<Vec2> area_numbers(const Vec3& p) const {
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    const double rho = rounded::hypot(p.x, p.y);
    return Vec2{*u, static_cast<float>((r_ - rho) * (r_ + rho) / ((double{r_} - inner_) * (double{r_} + inner_)))};
  }

 private:
  constexpr std::optional<Vec2> parameters(const DoubleVec3& p) const {
    const double rho = elementary::hypot(p.x, p.y);
    if (rho > r_ || rho < inner_) return std::nullopt;
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, v_of(rho)};
  }
  constexpr float v_of(double rho) const {
    return static_cast<float>(std::clamp((r_ - rho) / (double{r_} - inner_), 0.0, 1.0));
  }

  float height_, r_, inner_;
  Sweep sweep_;
};

}  // namespace dspm
