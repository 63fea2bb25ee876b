// A mesh of bilinear patches as plain arrays, for CPUs and GPUs: where rays meet a patch, the surface there, and areas.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounding.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/bilinear_patch.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// A patch's corners, as indices: p00, p10, p01, p11.
using PatchCorners = std::array<int, 4>;

/// Reads arrays that it does not own. Those that hold something per vertex are null if the mesh lacks it.
struct PatchMeshView {
  const Vec3* vertices = nullptr;
  const PatchCorners* patches = nullptr;
  const Vec3* normals = nullptr;  // of any length
  const Vec2* uvs = nullptr;
  std::size_t vertex_count = 0, patch_count = 0;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(vertices, vertex_count);
    fn(patches, patch_count);
    fn(normals, vertex_count);
    fn(uvs, vertex_count);
  }
};

/// One of the patches, with the interface of quadrics.
class PatchSurface {
 public:
  constexpr PatchSurface(const PatchMeshView& mesh, int number) : mesh_(mesh), corners_(mesh.patches + number) {}

  constexpr Bounds3 bounds() const {
    Bounds3 b;
    for (std::size_t corner = 0; corner < 4; ++corner) b.add(at_corner(mesh_.vertices, corner));
    return b;
  }

  constexpr std::optional<PrimitiveHit> intersect(const Ray& ray) const { return patch().intersect(ray); }

  template <std::derived_from<SurfaceGeometry> Point = SurfaceGeometry>
  constexpr Point surface_point(Vec2 uv) const {
    const BilinearPatch p = patch();
    const Bounds3 box = bounds();
    const float size_error = gamma_bound(4) * max_component(box.high - box.low);
    Point s;
    s.p = narrow(p.at(uv.x, uv.y));
    s.p_error = gamma_bound(2) * abs(s.p) + Vec3{size_error, size_error, size_error};
    s.ng = normal_of(p, uv);
    s.ns = s.ng;
    if (mesh_.normals != nullptr) {
      const Vec3 n = interpolated(mesh_.normals, uv);
      if (dot(n, s.ng) < 0) s.ng = -s.ng;
      s.ns = length2(n) > 0 && dot(n, s.ng) > 0 ? normalize(n) : s.ng;
    }
    s.uv = mesh_.uvs == nullptr ? uv : interpolated(mesh_.uvs, uv);
    set_tangents(s, p, uv);
    return s;
  }

  constexpr float area() const { return static_cast<float>(patch().area()); }
  constexpr Vec2 sample_area(Vec2 u) const {
    const auto uv = patch().uniform(u);
    return {static_cast<float>(uv[0]), static_cast<float>(uv[1])};
  }
  constexpr std::optional<Vec2> area_numbers(const Vec3& p) const {
    const BilinearPatch on = patch();
    const auto uv = on.parameters(p);
    if (!uv) return std::nullopt;
    const Vec2 numbers = on.uniform_numbers((*uv)[0], (*uv)[1]);
    if (numbers.x - numbers.x != 0 || numbers.y - numbers.y != 0) return std::nullopt;
    return numbers;
  }

 private:
  template <class T>
  constexpr const T& at_corner(const T* of_vertices, std::size_t corner) const {
    return of_vertices[(*corners_)[corner]];
  }
  constexpr BilinearPatch patch() const {
    const auto vertex = [&](std::size_t corner) { return at_corner(mesh_.vertices, corner); };
    return {vertex(0), vertex(1), vertex(2), vertex(3)};
  }

  template <class T>
  constexpr T interpolated(const T* of_vertices, Vec2 uv) const {
    const auto at = [&](std::size_t c) { return at_corner(of_vertices, c); };
    return (at(0) * (1 - uv.x) + at(1) * uv.x) * (1 - uv.y) + (at(2) * (1 - uv.x) + at(3) * uv.x) * uv.y;
  }

  /// Returns the normal; in a corner or on an edge without one, that of the middle.
  static constexpr Vec3 normal_of(const BilinearPatch& p, Vec2 uv) {
    const Vec2 places[] = {uv, {0.5f, 0.5f}};
    for (const Vec2& place : places) {
      const DoubleVec3 n = p.normal(place.x, place.y);
      if (length(n) > 0) return narrow(n * (1 / length(n)));
    }
    return {0, 0, 1};
  }

  /// Sets dp/ds along the first texture coordinate s; any tangent if there is none. The derivatives by texture
  /// coordinates are those by u and v times the inverse of the coordinates' own.
  constexpr void set_tangents(SurfaceGeometry& s, const BilinearPatch& p, Vec2 uv) const {
    const Vec3 by_u = narrow(p.along_u(uv.y)), by_v = narrow(p.along_v(uv.x));
    s.dpdu = by_u, s.dpdv = by_v;
    if (mesh_.uvs != nullptr) {
      const auto st = [&](std::size_t c) { return at_corner(mesh_.uvs, c); };
      const Vec2 st_by_u = (st(1) - st(0)) * (1 - uv.y) + (st(3) - st(2)) * uv.y;
      const Vec2 st_by_v = (st(2) - st(0)) * (1 - uv.x) + (st(3) - st(1)) * uv.x;
      const float determinant = st_by_u.x * st_by_v.y - st_by_v.x * st_by_u.y;
      s.dpdu = (by_u * st_by_v.y - by_v * st_by_u.y) / determinant;
      s.dpdv = (by_v * st_by_u.x - by_u * st_by_v.x) / determinant;
    }
    if (is_finite(s.dpdu) && length2(cross(s.ng, s.dpdu)) > 0) {
      if (!is_finite(s.dpdv)) s.dpdv = {};
      return;
    }
    s.dpdu = Basis::around(s.ng).x, s.dpdv = {};
  }

  PatchMeshView mesh_;
  const PatchCorners* corners_;
};

}  // namespace dspm
