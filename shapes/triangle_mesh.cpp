#include "dspm/shapes/triangle_mesh.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/mesh_view.h"
#include "dspm/shapes/triangle.h"

namespace dspm {
namespace {

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
    for (std::uint8_t& turned : world.turned) turned = turned == 0;
  }
  return TriangleMesh(std::move(world));
}

std::size_t TriangleMesh::memory() const {
  return sizeof *this +
         (data_.vertices.capacity() + data_.normals.capacity() + data_.tangents.capacity() +
          data_.velocities.capacity()) *
             sizeof(Vec3) +
         (data_.uvs.capacity() + data_.second_uvs.capacity()) * sizeof(Vec2) +
         data_.colours.capacity() * sizeof data_.colours[0] + data_.turned.capacity() +
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

MeshView TriangleMesh::view() const {
  const auto array = [](const auto& of_vertices) { return of_vertices.empty() ? nullptr : of_vertices.data(); };
  return {.vertices = data_.vertices.data(),
          .faces = data_.faces.data(),
          .normals = array(data_.normals),
          .uvs = array(data_.uvs),
          .tangents = array(data_.tangents),
          .turned = array(data_.turned),
          .vertex_count = data_.vertices.size(),
          .face_count = data_.faces.size()};
}

SurfacePoint TriangleMesh::surface_point(int primitive, Vec2 uv) const {
  SurfacePoint s = view().surface_point<SurfacePoint>(primitive, uv);
  if (!data_.second_uvs.empty() || !data_.colours.empty()) s.vertices = {this, primitive, uv};
  return s;
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
  const MeshView mesh = view();
  const auto first = mesh.corner_uvs(triangle);
  const auto& own = data_.second_uvs;
  const auto second = own.empty() ? first : mesh.corners_of(own.data(), triangle);
  SecondUv result{second[0] * (1 - at.x - at.y) + second[1] * at.x + second[2] * at.y, {}, {}};
  const Vec2 a = first[1] - first[0], b = first[2] - first[0], da = second[1] - second[0], db = second[2] - second[0];
  const float determinant = a.x * b.y - b.x * a.y;
  if (std::abs(determinant) > 1e-9f) {
    result.by_u = (da * b.y - db * a.y) * (1 / determinant);
    result.by_v = (db * a.x - da * b.x) * (1 / determinant);
  }
  return result;
}

float TriangleMesh::area(int primitive) const { return view().area(primitive); }

Vec2 TriangleMesh::sample_area(int, Vec2 u) const { return MeshView::sample_area(u); }

std::optional<Vec2> TriangleMesh::area_numbers(int primitive, const Vec3& p) const {
  return view().area_numbers(primitive, p);
}

}  // namespace dspm
