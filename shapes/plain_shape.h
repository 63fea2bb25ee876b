// A shape of one primitive as a plain value, which a device can have: one of a few kinds.
#pragma once

#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/cylinder.h"
#include "dspm/shapes/disk.h"
#include "dspm/shapes/sphere.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class PlainShape {
  enum class Kind : unsigned char { none, sphere, disk, cylinder };

  struct Nothing {
    constexpr std::optional<PrimitiveHit> intersect(const Ray&) const { return std::nullopt; }
    constexpr Bounds3 bounds() const { return {}; }
    template <class Point>
    constexpr Point surface_point(Vec2) const {
      return {};
    }
  };

  template <class Fn>
  constexpr auto of_kind(Fn&& fn) const {
    switch (kind_) {
      case Kind::sphere: return fn(sphere_);
      case Kind::disk: return fn(disk_);
      case Kind::cylinder: return fn(cylinder_);
      case Kind::none: break;
    }
    return fn(Nothing());
  }

 public:
  constexpr PlainShape() : kind_(Kind::none), nothing_() {}
  constexpr PlainShape(const SphereSurface& sphere) : kind_(Kind::sphere), sphere_(sphere) {}
  constexpr PlainShape(const DiskSurface& disk) : kind_(Kind::disk), disk_(disk) {}
  constexpr PlainShape(const CylinderSurface& cylinder) : kind_(Kind::cylinder), cylinder_(cylinder) {}

  constexpr std::optional<PrimitiveHit> intersect(const Ray& ray) const {
    return of_kind([&](const auto& surface) { return surface.intersect(ray); });
  }
  constexpr Bounds3 bounds() const {
    return of_kind([](const auto& surface) { return surface.bounds(); });
  }
  constexpr SurfaceGeometry surface_point(Vec2 uv) const {
    return of_kind([&](const auto& surface) { return surface.template surface_point<SurfaceGeometry>(uv); });
  }

 private:
  Kind kind_;
  union {
    Nothing nothing_;
    SphereSurface sphere_;
    DiskSurface disk_;
    CylinderSurface cylinder_;
  };
};

}  // namespace dspm
