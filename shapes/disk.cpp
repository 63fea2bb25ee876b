// Shape "disk" "float radius" 0.5
//
// A disk, ring or sector in the plane z = height. Its normal is +z.
//
// | parameter   | default | meaning |
// | ----------- | ------- | ------- |
// | height      | 0       | z of the plane |
// | radius      | 1       | outer radius |
// | innerradius | 0       | radius of the hole |
// | phimax      | 360     | the angle that it covers around z (degrees) |
//
// u runs around z from the x axis, v from the rim inward. [Pharr, Jakob, Humphreys, Physically Based
// Rendering, 6.4]
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/quadric.h"
#include "dspm/shapes/rounding.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

class Disk final : public Shape {
 public:
  Disk(float height, float radius, float inner, const Sweep& sweep)
      : height_(height), r_(radius), inner_(inner), sweep_(sweep) {}

  Bounds3 bounds(int) const override {
    const float r = r_ * (1 + gamma_bound(4));
    return {{-r, -r, height_}, {r, r, height_}};
  }

  std::optional<PrimitiveHit> intersect(int, const Ray& ray) const override {
    const DoubleVec3 o = widen(ray.origin), d = widen(ray.direction);
    if (d.z == 0) return std::nullopt;
    const double t = (height_ - o.z) / d.z;
    return first_hit({{t, t}}, ray.t_max, [&](double root) { return parameters(o + d * root); });
  }

  SurfacePoint surface_point(int, Vec2 uv) const override {
    const double phi = sweep_.phi(uv.x), c = std::cos(phi), s = std::sin(phi), rho = r_ + uv.y * (double{inner_} - r_);
    SurfacePoint point;
    point.p = narrow({rho * c, rho * s, height_});
    point.p_error = gamma_bound(2) * Vec3{std::abs(point.p.x), std::abs(point.p.y), 0};
    point.ng = point.ns = {0, 0, 1};
    point.dpdu = narrow(DoubleVec3{-s, c, 0} * (std::max(rho, kLeastSine * r_) * sweep_.phi_max()));
    point.dpdv = narrow(DoubleVec3{c, s, 0} * (double{inner_} - r_));
    point.uv = uv;
    return point;
  }

  float area(int) const override {
    return static_cast<float>(0.5 * sweep_.phi_max() * (double{r_} - inner_) * (double{r_} + inner_));
  }

  // The area within a radius grows with its square.
  Vec2 sample_area(int, Vec2 u) const override {
    const double inner2 = double{inner_} * inner_, outer2 = double{r_} * r_;
    return {u.x, v_of(std::sqrt(outer2 + u.y * (inner2 - outer2)))};
  }
  std::optional<Vec2> area_numbers(int, const Vec3& p) const override {
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    const double rho = rounded::hypot(p.x, p.y);
    return Vec2{*u, static_cast<float>((r_ - rho) * (r_ + rho) / ((double{r_} - inner_) * (double{r_} + inner_)))};
  }

 private:
  std::optional<Vec2> parameters(const DoubleVec3& p) const {
    const double rho = std::hypot(p.x, p.y);
    if (rho > r_ || rho < inner_) return std::nullopt;
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, v_of(rho)};
  }
  float v_of(double rho) const { return static_cast<float>(std::clamp((r_ - rho) / (double{r_} - inner_), 0.0, 1.0)); }

  float height_, r_, inner_;
  Sweep sweep_;
};

}  // namespace

std::vector<MadeShape> make_disk(ParamReader& reader) {
  const float height = reader.number("height", 0, "scene units", "z of the disk's plane");
  const float radius = read_positive(reader, "radius", 1, "outer radius");
  const float inner = reader.number("innerradius", 0, "scene units", "radius of the hole");
  const Sweep sweep(reader);
  reader.finish();

  std::vector<MadeShape> made;
  if (inner < 0 || inner >= radius)
    reader.error("innerradius", "\"innerradius\" must be at least 0 and below \"radius\"");
  else
    made.push_back({std::make_unique<Disk>(height, radius, inner, sweep), std::nullopt});
  return made;
}

}  // namespace dspm
