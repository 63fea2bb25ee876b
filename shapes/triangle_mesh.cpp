#include "dspm/shapes/triangle_mesh.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/rounding.h"
#include "dspm/shapes/triangle.h"

namespace dspm {
namespace {

// Trees that test triangles in float alone round coordinates relative to the ray's origin: a point's error is at least
// this many roundings of the triangle's size, even on a plane such as z = 0 whose points have no error of their own.
constexpr int kSizeRoundings = 4;

Vec3 unit_normal(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  const DoubleVec3 n = area_vector(p0, p1, p2);
  return narrow(n * (1 / length(n)));
}

const Vec3& at(const std::vector<Vec3>& values, int index) { return values[static_cast<std::size_t>(index)]; }

}  // namespace

std::optional<std::string> fault_of(const MeshData& data) {
  const std::size_t count = data.vertices.size();
  constexpr std::size_t most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (data.faces.empty()) return "the mesh has no faces";
  if (count > most || data.faces.size() > most) return "the mesh has more than 2^31 - 1 vertices or faces";
  if (!data.normals.empty() && data.normals.size() != count)
    return fmt::format("{} normals for {} vertices", data.normals.size(), count);
  if (!data.uvs.empty() && data.uvs.size() != count)
    return fmt::format("{} texture coordinates for {} vertices", data.uvs.size(), count);
  if (!data.tangents.empty() && data.tangents.size() != count)
    return fmt::format("{} tangents for {} vertices", data.tangents.size(), count);
  if (!data.turned.empty() && data.turned.size() != data.tangents.size())
    return fmt::format("{} signs for {} tangents", data.turned.size(), data.tangents.size());
  if (!data.second_uvs.empty() && data.second_uvs.size() != count)
    return fmt::format("{} second texture coordinates for {} vertices", data.second_uvs.size(), count);
  if (!data.colours.empty() && data.colours.size() != count)
    return fmt::format("{} colours for {} vertices", data.colours.size(), count);
  if (!data.velocities.empty() && data.velocities.size() != count)
    return fmt::format("{} velocities for {} vertices", data.velocities.size(), count);
  for (std::size_t i = 0; i < data.faces.size(); ++i)
    for (const int v : data.faces[i])
      if (v < 0 || static_cast<std::size_t>(v) >= count)
        return fmt::format("face {} refers to vertex {}, but the mesh has vertices 0 to {}", i, v,
                           static_cast<long>(count) - 1);
  for (std::size_t i = 0; i < count; ++i)
    if (!is_finite(data.vertices[i])) return fmt::format("vertex {} is not finite", i);
  for (std::size_t i = 0; i < data.velocities.size(); ++i)
    if (!is_finite(data.velocities[i])) return fmt::format("the velocity of vertex {} is not finite", i);
  return std::nullopt;
}

TriangleMesh::TriangleMesh(MeshData data) : data_(std::move(data)) {
  if (const auto fault = fault_of(data_)) throw std::invalid_argument(*fault);
  if (data_.normals.empty()) return;
  for (Vec3& n : data_.normals) n = length2(n) > 0 && is_finite(n) ? normalize(n) : Vec3{};
  for (Face& f : data_.faces) {
    const Vec3 side = at(data_.normals, f[0]) + at(data_.normals, f[1]) + at(data_.normals, f[2]);
    const DoubleVec3 n = area_vector(at(data_.vertices, f[0]), at(data_.vertices, f[1]), at(data_.vertices, f[2]));
    if (dot(n, widen(side)) < 0) std::swap(f[1], f[2]);
  }
}

TriangleMesh TriangleMesh::transformed(const Transform& to_world) const {
  MeshData world = data_;
  world.velocities.clear();
  for (Vec3& p : world.vertices) p = to_world.point(p);
  for (Vec3& n : world.normals) n = to_world.normal(n);
  for (Vec3& t : world.tangents) t = to_world.vector(t);
  if (to_world.swaps_handedness()) {
    for (Face& f : world.faces) std::swap(f[1], f[2]);
    world.turned.flip();
  }
  return TriangleMesh(std::move(world));
}

std::size_t TriangleMesh::memory() const {
  return sizeof *this +
         (data_.vertices.capacity() + data_.normals.capacity() + data_.tangents.capacity() +
          data_.velocities.capacity()) *
             sizeof(Vec3) +
         (data_.uvs.capacity() + data_.second_uvs.capacity()) * sizeof(Vec2) +
         data_.colours.capacity() * sizeof data_.colours[0] + data_.turned.capacity() / 8 +
         data_.faces.capacity() * sizeof(Face);
}

Bounds3 TriangleMesh::bounds(int primitive) const {
  Bounds3 b;
  for (int corner = 0; corner < 3; ++corner) b.add(vertex(primitive, corner));
  return b;
}

std::optional<PrimitiveHit> TriangleMesh::intersect(int primitive, const Ray& ray) const {
  return dspm::intersect(TriangleRay(ray), vertex(primitive, 0), vertex(primitive, 1), vertex(primitive, 2), ray.t_max);
}

SurfacePoint TriangleMesh::surface_point(int primitive, Vec2 uv) const {
  const Vec3 &p0 = vertex(primitive, 0), &p1 = vertex(primitive, 1), &p2 = vertex(primitive, 2);
  const Vec3 b{1 - uv.x - uv.y, uv.x, uv.y};
  const Vec3 c0 = p0 * b.x, c1 = p1 * b.y, c2 = p2 * b.z;
  const float size = std::max(max_component(abs(p1 - p0)), max_component(abs(p2 - p0)));
  const float size_error = gamma_bound(kSizeRoundings) * size;

  SurfacePoint s;
  s.p = c0 + c1 + c2;
  s.p_error = gamma_bound(7) * (abs(c0) + abs(c1) + abs(c2)) + Vec3{size_error, size_error, size_error};
  s.ng = unit_normal(p0, p1, p2);
  s.ns = shading_normal(primitive, b, s.ng);
  if (data_.uvs.empty()) {  // see corner_uvs
    s.dpdu = p1 - p0, s.dpdv = p2 - p1;
    s.uv = {b.y + b.z, b.z};
  } else {
    const auto t = corner_uvs(primitive);
    set_tangents(s, primitive, t);
    s.uv = t[0] * b.x + t[1] * b.y + t[2] * b.z;
  }
  if (!data_.second_uvs.empty() || !data_.colours.empty()) s.vertices = {this, primitive, uv};
  if (!data_.tangents.empty()) take_given_tangent(s, primitive, b);
  return s;
}

std::array<Vec2, 3> TriangleMesh::corner_uvs(int face) const {
  if (data_.uvs.empty()) return {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}};  // as pbrt
  return corners_of(data_.uvs, face);
}

std::array<Vec2, 3> TriangleMesh::corners_of(const std::vector<Vec2>& uvs, int face) const {
  std::array<Vec2, 3> result;
  for (int corner = 0; corner < 3; ++corner)
    result[static_cast<std::size_t>(corner)] = uvs[static_cast<std::size_t>(index(face, corner))];
  return result;
}

std::array<float, 4> TriangleMesh::vertex_colour(int triangle, Vec2 at) const {
  if (data_.colours.empty()) return {1, 1, 1, 1};
  const float share[3] = {1 - at.x - at.y, at.x, at.y};
  std::array<float, 4> mean{};
  for (int corner = 0; corner < 3; ++corner)
    for (std::size_t c = 0; c < 4; ++c)
      mean[c] += share[corner] * data_.colours[static_cast<std::size_t>(index(triangle, corner))][c];
  return mean;
}

// Solves w_i - w_0 = (u_i - u_0) dw/du + (v_i - v_0) dw/dv for the second coordinates w.
VertexData::SecondUv TriangleMesh::second_uv(int triangle, Vec2 at) const {
  const auto first = corner_uvs(triangle);
  const auto& own = data_.second_uvs;
  const auto second = own.empty() ? first : corners_of(own, triangle);
  SecondUv result{second[0] * (1 - at.x - at.y) + second[1] * at.x + second[2] * at.y, {}, {}};
  const Vec2 a = first[1] - first[0], b = first[2] - first[0], da = second[1] - second[0], db = second[2] - second[0];
  const float determinant = a.x * b.y - b.x * a.y;
  if (std::abs(determinant) > 1e-9f) {
    result.by_u = (da * b.y - db * a.y) * (1 / determinant);
    result.by_v = (db * a.x - da * b.x) * (1 / determinant);
  }
  return result;
}

// Solves p_i - p_2 = (u_i - u_2) dp/du + (v_i - v_2) dp/dv; any tangent if the texture coordinates are degenerate.
void TriangleMesh::set_tangents(SurfacePoint& point, int face, const std::array<Vec2, 3>& t) const {
  const Vec2 uv02 = t[0] - t[2], uv12 = t[1] - t[2];
  const Vec3 p02 = vertex(face, 0) - vertex(face, 2), p12 = vertex(face, 1) - vertex(face, 2);
  const float determinant = uv02.x * uv12.y - uv02.y * uv12.x;
  const Vec3 dpdu = (p02 * uv12.y - p12 * uv02.y) / determinant, dpdv = (p12 * uv02.x - p02 * uv12.x) / determinant;
  const bool usable = std::abs(determinant) > 1e-9f && is_finite(dpdu) && length2(cross(point.ng, dpdu)) > 0;
  point.dpdu = usable ? dpdu : Basis::around(point.ng).x;
  if (usable && is_finite(dpdv)) point.dpdv = dpdv;
}

/// Takes the given tangent. It is a direction, so the derivative keeps its length; which way v runs may be given as
/// well.
void TriangleMesh::take_given_tangent(SurfacePoint& point, int face, const Vec3& barycentrics) const {
  const Vec3 given = at_point(data_.tangents, face, barycentrics), across = cross(point.ns, given);
  if (!is_finite(given) || !(length2(across) > 0)) return;
  point.dpdu = given * (length(point.dpdu) / length(given));
  if (data_.turned.empty()) return;
  const bool turned = data_.turned[static_cast<std::size_t>(index(face, 0))];
  if ((dot(across, point.dpdv) < 0) != turned) point.dpdv = -point.dpdv;
}

Vec3 TriangleMesh::shading_normal(int face, const Vec3& barycentrics, const Vec3& ng) const {
  if (data_.normals.empty()) return ng;
  const Vec3 n = at_point(data_.normals, face, barycentrics);
  return dot(n, ng) > 0 ? normalize(n) : ng;
}

Vec3 TriangleMesh::at_point(const std::vector<Vec3>& of_vertices, int face, const Vec3& barycentrics) const {
  return at(of_vertices, index(face, 0)) * barycentrics.x + at(of_vertices, index(face, 1)) * barycentrics.y +
         at(of_vertices, index(face, 2)) * barycentrics.z;
}

float TriangleMesh::area(int primitive) const {
  const DoubleVec3 n = area_vector(vertex(primitive, 0), vertex(primitive, 1), vertex(primitive, 2));
  return static_cast<float>(0.5 * length(n));
}

Vec2 TriangleMesh::sample_area(int, Vec2 u) const { return uniform_triangle(u); }

std::optional<Vec2> TriangleMesh::area_numbers(int primitive, const Vec3& p) const {
  const Vec3 &a = vertex(primitive, 0), e1 = vertex(primitive, 1) - a, e2 = vertex(primitive, 2) - a;
  const Vec3 n = cross(e1, e2), to_p = p - a;
  const float twice_area2 = length2(n);
  if (!(twice_area2 > 0)) return std::nullopt;
  return uniform_triangle_numbers({dot(cross(to_p, e2), n) / twice_area2, dot(cross(e1, to_p), n) / twice_area2});
}

}  // namespace dspm
