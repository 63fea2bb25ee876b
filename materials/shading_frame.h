// The frame of a Bsdf's directions: the shading frame around ns, and the geometric normal that distinguishes its two
// sides. Formulas see local directions with wo above (z > 0), whichever side it is on. If ns and ng disagree about the
// side that light comes from, there is no light, in sample, pdf_w and evaluate alike. The camera, though, may look at a
// surface whose ns turns away from it, at the rim of a mesh or under a steep normal map: it sees there what its twin
// would see, the direction that is mirrored in the plane across ns. So nothing turns black, and f has no edge where ns
// turns away. Photons may then leave in two directions that formulas do not tell apart, and choose one.
#pragma once

#include <cmath>
#include <optional>

#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class ShadingFrame {
 public:
  constexpr explicit ShadingFrame(const SurfaceGeometry& point) : ShadingFrame(point.ns, point.ng, point.dpdu) {}
  constexpr ShadingFrame(const Vec3& ns, const Vec3& ng, const Vec3& tangent)
      : x_(Basis::around(ns, tangent).x), z_(ns), ng_(ng) {}

  /// +1 outside, -1 inside, by the geometric normal.
  constexpr float side(const Vec3& w) const { return dot(w, ng_) > 0 ? 1.f : -1.f; }
  constexpr const Vec3& x() const { return x_; }
  constexpr const Vec3& ns() const { return z_; }
  constexpr const Vec3& ng() const { return ng_; }
  /// Converts w to the shading frame, which is mirrored if `side` is -1.
  constexpr Vec3 local(const Vec3& w, float side) const {
    return {dot(w, x_), dot(w, cross(z_, x_)), side * dot(w, z_)};
  }
  constexpr Vec3 world(const Vec3& w, float side) const { return x_ * w.x + cross(z_, x_) * w.y + z_ * (side * w.z); }

  /// Returns wo as formulas see it, above; nullopt if light comes from where ns does not face it.
  constexpr std::optional<Vec3> arrive(const Vec3& wo, float side, Transport transport) const {
    Vec3 o = local(wo, side);
    if (transport == Transport::radiance) o.z = std::abs(o.z);
    return o.z > 0 ? std::optional<Vec3>(o) : std::nullopt;
  }

  struct Leaving {
    Vec3 wi;      // in the world
    float share;  // of the local direction's density that is this one's
  };
  /// Returns the world direction of a sampled local one, chosen by `u` if there are two; nullopt if ng puts it on the
  /// other side.
  constexpr std::optional<Leaving> leave(const Vec3& local_wi, float side, Transport transport, float u) const {
    if (local_wi.z == 0) return std::nullopt;
    const float to = local_wi.z > 0 ? side : -side;
    const Vec3 wi = world(local_wi, side), other = twin(wi);
    const bool fits = this->side(wi) == to, other_fits = is_camera(transport) && this->side(other) == to;
    if (!fits && !other_fits) return std::nullopt;
    if (fits && other_fits) return Leaving{is_first(u) ? wi : other, 0.5f};
    return Leaving{fits ? wi : other, 1};
  }
  constexpr float share(const Vec3& wi, Transport transport) const {
    return is_camera(transport) && side(twin(wi)) == side(wi) ? 0.5f : 1.f;
  }

  friend constexpr bool operator==(const ShadingFrame&, const ShadingFrame&) = default;

 private:
  constexpr Vec3 twin(const Vec3& w) const { return w - z_ * (2 * dot(w, z_)); }
  /// Returns whether wi is the camera's direction, which may have a twin on its side.
  constexpr bool is_camera(Transport transport) const { return transport == Transport::flux && !(z_ == ng_); }
  /// Chooses by the last digits of a number whose first digits chose the local direction.
  static constexpr bool is_first(float u) {
    const float last_digits = u * 4096 - static_cast<float>(static_cast<int>(u * 4096));
    return last_digits < 0.5f;
  }

  Vec3 x_, z_;  // y is known from them: a Bsdf has little room
  Vec3 ng_;
};

/// wo and wi in the shading frame, wo above, the camera's turned to ns. `valid` if both normals agree about the
/// light's.
struct LocalPair {
  float side;
  Vec3 wo, wi;
  bool valid;
  float share;  // of the density of the local wi

  constexpr LocalPair(const ShadingFrame& frame, const Vec3& world_wo, const Vec3& world_wi, Transport transport)
      : side(frame.side(world_wo)),
        wo(frame.local(world_wo, side)),
        wi(frame.local(world_wi, side)),
        share(frame.share(world_wi, transport)) {
    const float to = frame.side(world_wi) == side ? 1.f : -1.f;
    if (transport == Transport::radiance)
      wo.z = std::abs(wo.z);
    else
      wi.z = std::copysign(wi.z, to);
    valid = wo.z > 0 && to * wi.z > 0;
  }
  constexpr bool reflection() const { return valid && wi.z > 0; }
};

}  // namespace dspm
