// A triangle mesh as plain arrays, for CPUs and GPUs: the surface at a point of a triangle, and the triangles' areas.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/rounding.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/shapes/triangle.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Reads arrays that it does not own. Those that hold something per vertex are null if the mesh lacks it.
struct MeshView {
  // Trees that test triangles in float alone round coordinates relative to the ray's origin: a point's error is at least
  // this many roundings of the triangle's size, even on a plane such as z = 0 whose points have no error of their own.
  static constexpr int kSizeRoundings = 4;

  const Vec3* vertices = nullptr;
  const Face* faces = nullptr;
  const Vec3* normals = nullptr;  // unit length, or zero
  const Vec2* uvs = nullptr;
  const Vec3* tangents = nullptr;        // along u, of any length
  const std::uint8_t* turned = nullptr;  // 0 or 1, beside tangents: whether v runs against cross(n, tangent)
  std::size_t vertex_count = 0, face_count = 0;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(vertices, vertex_count);
    fn(faces, face_count);
    fn(normals, vertex_count);
    fn(uvs, vertex_count);
    fn(tangents, vertex_count);
    fn(turned, vertex_count);
  }

  constexpr std::size_t index(int face, int corner) const {
    return static_cast<std::size_t>(faces[face][static_cast<std::size_t>(corner)]);
  }
  constexpr const Vec3& vertex(int face, int corner) const { return vertices[index(face, corner)]; }
  constexpr std::array<Vec2, 3> corners_of(const Vec2* of_vertices, int face) const {
    return {of_vertices[index(face, 0)], of_vertices[index(face, 1)], of_vertices[index(face, 2)]};
  }
  constexpr std::array<Vec2, 3> corner_uvs(int face) const {
    if (uvs == nullptr) return {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}};  // as pbrt
    return corners_of(uvs, face);
  }

  /// Returns the surface at a triangle's point, whose second and third vertex have the barycentrics `at`.
  template <std::derived_from<SurfaceGeometry> Point = SurfaceGeometry>
  constexpr Point surface_point(int face, Vec2 at) const {
    const Vec3 &p0 = vertex(face, 0), &p1 = vertex(face, 1), &p2 = vertex(face, 2);
    const Vec3 b{1 - at.x - at.y, at.x, at.y};
    const Vec3 c0 = p0 * b.x, c1 = p1 * b.y, c2 = p2 * b.z;
    const float size = std::max(max_component(abs(p1 - p0)), max_component(abs(p2 - p0)));
    const float size_error = gamma_bound(kSizeRoundings) * size;

    Point s;
    s.p = c0 + c1 + c2;
    s.p_error = gamma_bound(7) * (abs(c0) + abs(c1) + abs(c2)) + Vec3{size_error, size_error, size_error};
    s.ng = unit_normal(p0, p1, p2);
    s.ns = shading_normal(face, b, s.ng);
    if (uvs == nullptr) {  // see corner_uvs
      s.dpdu = p1 - p0, s.dpdv = p2 - p1;
      s.uv = {b.y + b.z, b.z};
    } else {
      const auto t = corner_uvs(face);
      set_tangents(s, face, t);
      s.uv = t[0] * b.x + t[1] * b.y + t[2] * b.z;
    }
    if (tangents != nullptr) take_given_tangent(s, face, b);
    return s;
  }

  constexpr float area(int face) const {
    const DoubleVec3 n = area_vector(vertex(face, 0), vertex(face, 1), vertex(face, 2));
    return static_cast<float>(0.5 * length(n));
  }
  /// Returns the barycentrics of a point distributed uniformly over a triangle.
  static constexpr Vec2 sample_area(Vec2 u) { return uniform_triangle(u); }
  /// Returns the numbers for which sample_area() gives the point p of the triangle, up to rounding.
  constexpr std::optional<Vec2> area_numbers(int face, const Vec3& p) const {
    const Vec3 &a = vertex(face, 0), e1 = vertex(face, 1) - a, e2 = vertex(face, 2) - a;
    const Vec3 n = cross(e1, e2), to_p = p - a;
    const float twice_area2 = length2(n);
    if (!(twice_area2 > 0)) return std::nullopt;
    return uniform_triangle_numbers({dot(cross(to_p, e2), n) / twice_area2, dot(cross(e1, to_p), n) / twice_area2});
  }

 private:
  static constexpr Vec3 unit_normal(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    const DoubleVec3 n = area_vector(p0, p1, p2);
    return narrow(n * (1 / length(n)));
  }

  constexpr Vec3 at_point(const Vec3* of_vertices, int face, const Vec3& barycentrics) const {
    return of_vertices[index(face, 0)] * barycentrics.x + of_vertices[index(face, 1)] * barycentrics.y +
           of_vertices[index(face, 2)] * barycentrics.z;
  }

  constexpr Vec3 shading_normal(int face, const Vec3& barycentrics, const Vec3& ng) const {
    if (normals == nullptr) return ng;
    const Vec3 n = at_point(normals, face, barycentrics);
    return dot(n, ng) > 0 ? normalize(n) : ng;
  }

  // Solves p_i - p_2 = (u_i - u_2) dp/du + (v_i - v_2) dp/dv; any tangent if the texture coordinates are degenerate.
  constexpr void set_tangents(SurfaceGeometry& point, int face, const std::array<Vec2, 3>& t) const {
    const Vec2 uv02 = t[0] - t[2], uv12 = t[1] - t[2];
    const Vec3 p02 = vertex(face, 0) - vertex(face, 2), p12 = vertex(face, 1) - vertex(face, 2);
    const float determinant = uv02.x * uv12.y - uv02.y * uv12.x;
    const Vec3 dpdu = (p02 * uv12.y - p12 * uv02.y) / determinant, dpdv = (p12 * uv02.x - p02 * uv12.x) / determinant;
    const bool usable = std::abs(determinant) > 1e-9f && is_finite(dpdu) && length2(cross(point.ng, dpdu)) > 0;
    point.dpdu = usable ? dpdu : Basis::around(point.ng).x;
    if (usable && is_finite(dpdv)) point.dpdv = dpdv;
  }

  // Takes the given tangent. It is a direction, so the derivative keeps its length. The sign is that of the triangle's first
  // vertex.
  constexpr void take_given_tangent(SurfaceGeometry& point, int face, const Vec3& barycentrics) const {
    const Vec3 given = at_point(tangents, face, barycentrics), across = cross(point.ns, given);
    if (!is_finite(given) || !(length2(across) > 0)) return;
    point.dpdu = given * (length(point.dpdu) / length(given));
    if (turned != nullptr && (dot(across, point.dpdv) < 0) != (turned[index(face, 0)] != 0)) point.dpdv = -point.dpdv;
  }
};

}  // namespace dspm
