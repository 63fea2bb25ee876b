// A shape as a plain value, which a device can have: one of a few kinds. Meshes of triangles are not among them, as trees
// treat them specially (mesh_view.h).
#pragma once

#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/bilinearmesh.h"
#include "dspm/shapes/cylinder.h"
#include "dspm/shapes/disk.h"
#include "dspm/shapes/sphere.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class PlainShape {
  enum class Kind : unsigned char { none, sphere, disk, cylinder, patches };

  struct Nothing {
    constexpr std::optional<PrimitiveHit> intersect(const Ray&) const { return std::nullopt; }
    constexpr Bounds3 bounds() const { return {}; }
    template <class Point>
    constexpr Point surface_point(Vec2) const {
      return {};
    }
  };

  /// Calls fn(surface) with that of the primitive.
  template <class Fn>
  constexpr auto with_surface(int primitive, Fn&& fn) const {
    switch (kind_) {
      case Kind::sphere: return fn(sphere_);
      case Kind::disk: return fn(disk_);
      case Kind::cylinder: return fn(cylinder_);
      case Kind::patches: return fn(PatchSurface(patches_, primitive));
      case Kind::none: break;
    }
    return fn(Nothing());
  }

 public:
  constexpr PlainShape() : kind_(Kind::none), nothing_() {}
  constexpr PlainShape(const SphereSurface& sphere) : kind_(Kind::sphere), sphere_(sphere) {}
  constexpr PlainShape(const DiskSurface& disk) : kind_(Kind::disk), disk_(disk) {}
  constexpr PlainShape(const CylinderSurface& cylinder) : kind_(Kind::cylinder), cylinder_(cylinder) {}
  constexpr PlainShape(const PatchMeshView& patches) : kind_(Kind::patches), patches_(patches) {}

  // Never inlined: trees meet shapes in several places, and devices would have the code of all kinds in each.
  [[gnu::noinline]] constexpr std::optional<PrimitiveHit> intersect(int primitive, const Ray& ray) const {
    return with_surface(primitive, [&](const auto& surface) { return surface.intersect(ray); });
  }
  constexpr Bounds3 bounds(int primitive) const {
    return with_surface(primitive, [](const auto& surface) { return surface.bounds(); });
  }
  [[gnu::noinline]] constexpr SurfaceGeometry surface_point(int primitive, Vec2 uv) const {
    return with_surface(primitive,
                        [&](const auto& surface) { return surface.template surface_point<SurfaceGeometry>(uv); });
  }

  /// Calls fn(kind) with what it is.
  template <class Fn>
  constexpr void of_kind(Fn&& fn) {
    switch (kind_) {
      case Kind::sphere: return fn(sphere_);
      case Kind::disk: return fn(disk_);
      case Kind::cylinder: return fn(cylinder_);
      case Kind::patches: return fn(patches_);
      case Kind::none: break;
    }
    fn(nothing_);
  }
  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    if (kind_ == Kind::patches) patches_.each_array(fn);
  }

 private:
  Kind kind_;
  union {
    Nothing nothing_;
    SphereSurface sphere_;
    DiskSurface disk_;
    CylinderSurface cylinder_;
    PatchMeshView patches_;
  };
};

}  // namespace dspm
