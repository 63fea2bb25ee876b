// Shape "cylinder" "float radius" 0.5 "float zmin" 0 "float zmax" 2
//
// A cylinder around the z axis, without caps. Its normals point away from the axis.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | radius    | 1       | radius |
// | zmin      | -1      | lower end |
// | zmax      | 1       | upper end |
// | phimax    | 360     | the angle that it covers around z (degrees) |
//
// u runs around z from the x axis, v from zmin to zmax. [Pharr, Jakob, Humphreys, Physically Based Rendering, 6.3]
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/quadric.h"
#include "dspm/shapes/rounding.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

class Cylinder final : public Shape {
 public:
  Cylinder(float radius, float z_min, float z_max, const Sweep& sweep)
      : r_(radius), z_min_(z_min), z_max_(z_max), sweep_(sweep) {}

  Bounds3 bounds(int) const override {
    const float r = r_ * (1 + gamma_bound(4));
    return {{-r, -r, z_min_}, {r, r, z_max_}};
  }

  std::optional<PrimitiveHit> intersect(int, const Ray& ray) const override {
    const DoubleVec3 o = widen(ray.origin), d = widen(ray.direction);
    const auto roots = meet_round({o.x, o.y, 0}, {d.x, d.y, 0}, r_);
    if (!roots) return std::nullopt;
    return first_hit(*roots, ray.t_max, [&](double t) { return parameters(o + d * t); });
  }

  SurfacePoint surface_point(int, Vec2 uv) const override {
    const double phi = sweep_.phi(uv.x), c = std::cos(phi), s = std::sin(phi);
    SurfacePoint point;
    point.p = narrow({r_ * c, r_ * s, z_min_ + uv.y * (double{z_max_} - z_min_)});
    point.p_error = gamma_bound(2) * abs(point.p);
    point.ng = point.ns = narrow({c, s, 0});
    point.dpdu = narrow(DoubleVec3{-s, c, 0} * (r_ * sweep_.phi_max()));
    point.dpdv = {0, 0, z_max_ - z_min_};
    point.uv = uv;
    return point;
  }

  float area(int) const override { return static_cast<float>(sweep_.phi_max() * r_ * (double{z_max_} - z_min_)); }

  Vec2 sample_area(int, Vec2 u) const override { return u; }
  std::optional<Vec2> area_numbers(int, const Vec3& p) const override { return parameters(widen(p)); }

 private:
  std::optional<Vec2> parameters(const DoubleVec3& p) const {
    if (p.z < z_min_ || p.z > z_max_) return std::nullopt;
    const auto u = sweep_.u_of(p.x, p.y);
    if (!u) return std::nullopt;
    return Vec2{*u, static_cast<float>((p.z - z_min_) / (double{z_max_} - z_min_))};
  }

  float r_, z_min_, z_max_;
  Sweep sweep_;
};

}  // namespace

std::vector<MadeShape> make_cylinder(ParamReader& reader) {
  const float radius = read_positive(reader, "radius", 1, "radius");
  const float z0 = reader.number("zmin", -1, "scene units", "lower end");
  const float z1 = reader.number("zmax", 1, "scene units", "upper end");
  const Sweep sweep(reader);
  reader.finish();

  std::vector<MadeShape> made;
  if (z0 == z1)
    reader.error("zmin", "\"zmin\" and \"zmax\" are equal: the cylinder has no height");
  else
    made.push_back({std::make_unique<Cylinder>(radius, std::min(z0, z1), std::max(z0, z1), sweep), std::nullopt});
  return made;
}

}  // namespace dspm
