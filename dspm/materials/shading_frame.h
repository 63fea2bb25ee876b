// The frame of a Bsdf's directions: the shading frame around ns, and the geometric normal that distinguishes its two
// sides. Formulas see local directions with wo above (z > 0), whichever side it is on; if ns and ng disagree about a
// direction's side, there is no light, in sample, pdf_w and evaluate alike.
#pragma once

#include <optional>

#include "dspm/math/vec.h"
#include "dspm/shapes/shape.h"

namespace dspm {

class ShadingFrame {
 public:
  explicit ShadingFrame(const SurfacePoint& point) : ShadingFrame(point.ns, point.ng, point.dpdu) {}
  ShadingFrame(const Vec3& ns, const Vec3& ng, const Vec3& tangent)
      : x_(Basis::around(ns, tangent).x), z_(ns), ng_(ng) {}

  /// +1 outside, -1 inside, by the geometric normal.
  float side(const Vec3& w) const { return dot(w, ng_) > 0 ? 1.f : -1.f; }
  const Vec3& x() const { return x_; }
  const Vec3& ns() const { return z_; }
  const Vec3& ng() const { return ng_; }
  /// In the shading frame, which is mirrored if `side` is -1.
  Vec3 local(const Vec3& w, float side) const { return {dot(w, x_), dot(w, cross(z_, x_)), side * dot(w, z_)}; }
  Vec3 world(const Vec3& w, float side) const { return x_ * w.x + cross(z_, x_) * w.y + z_ * (side * w.z); }

  /// The world direction of a sampled local one; nullopt if the geometric normal puts it on the other side.
  std::optional<Vec3> leave(const Vec3& local_wi, float side) const {
    const Vec3 wi = world(local_wi, side);
    const bool above = local_wi.z > 0;
    if (local_wi.z == 0 || (this->side(wi) == side) != above) return std::nullopt;
    return wi;
  }

  friend bool operator==(const ShadingFrame&, const ShadingFrame&) = default;

 private:
  Vec3 x_, z_;  // y is known from them: a Bsdf has little room
  Vec3 ng_;
};

/// wo and wi in the shading frame, wo above. `valid` if both normals agree about both of them.
struct LocalPair {
  float side;
  Vec3 wo, wi;
  bool valid;

  LocalPair(const ShadingFrame& frame, const Vec3& world_wo, const Vec3& world_wi)
      : side(frame.side(world_wo)), wo(frame.local(world_wo, side)), wi(frame.local(world_wi, side)) {
    const bool reflected = frame.side(world_wi) == side;
    valid = wo.z > 0 && (reflected ? wi.z > 0 : wi.z < 0);
  }
  bool reflection() const { return valid && wi.z > 0; }
};

}  // namespace dspm
