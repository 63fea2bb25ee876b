// Triangles with shared vertices: the result of every mesh file and every subdivision, and the one shape whose data
// trees use directly. The order of a face's vertices defines its outside.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/math/vertex_data.h"
#include "dspm/shapes/shape.h"

namespace dspm {

struct MeshView;

/// Indices of a triangle's vertices.
using Face = std::array<int, 3>;

/// A mesh's plain data, as readers deliver it.
struct MeshData {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;  // one per vertex, any length, or none
  std::vector<Vec2> uvs;      // one per vertex, or none
  std::vector<Face> faces;
  std::vector<Vec3> tangents = {};        // along u, one per vertex, any length, or none
  std::vector<std::uint8_t> turned = {};  // 1: v runs against cross(n, tangent), else 0; one per vertex, or none
  std::vector<Vec2> second_uvs = {};      // one per vertex, or none
  std::vector<std::array<float, 4>> colours = {};  // likewise: linear red, green, blue, and opacity
  std::vector<Vec3> velocities = {};               // likewise: see moved() in deform.h
};

/// Returns why `data` is not a mesh (an index out of range, a wrong count, a coordinate that is not finite); nullopt if
/// it is one.
std::optional<std::string> fault_of(const MeshData& data);

class TriangleMesh final : public Shape, public VertexData {
 public:
  /// Throws std::invalid_argument with fault_of(data). If there are normals, faces are turned to their side.
  explicit TriangleMesh(MeshData data);

  const std::vector<Vec3>& vertices() const { return data_.vertices; }
  const std::vector<Vec3>& normals() const { return data_.normals; }  // unit length (or zero, as in the file)
  const std::vector<Vec2>& uvs() const { return data_.uvs; }
  const std::vector<Face>& faces() const { return data_.faces; }
  const std::vector<Vec3>& tangents() const { return data_.tangents; }
  const MeshData& data() const { return data_; }
  /// Returns the arrays for mesh_view.h; it is valid as long as the mesh.
  MeshView view() const;
  const Vec3& vertex(int face, int corner) const {
    return data_.vertices[static_cast<std::size_t>(index(face, corner))];
  }
  /// Returns the mesh with its vertices in world space, without velocities; its outside stays the outside even if
  /// `to_world` mirrors.
  TriangleMesh transformed(const Transform& to_world) const;
  std::size_t memory() const;  // bytes

  int primitive_count() const override { return static_cast<int>(data_.faces.size()); }
  Bounds3 bounds(int primitive) const override;
  std::optional<PrimitiveHit> intersect(int primitive, const Ray& ray) const override;
  SurfacePoint surface_point(int primitive, Vec2 uv) const override;
  float area(int primitive) const override;
  Vec2 sample_area(int primitive, Vec2 u) const override;
  std::optional<Vec2> area_numbers(int primitive, const Vec3& p) const override;
  const TriangleMesh* triangles() const override { return this; }
  std::array<float, 4> vertex_colour(int triangle, Vec2 at) const override;
  SecondUv second_uv(int triangle, Vec2 at) const override;

 private:
  int index(int face, int corner) const {
    return data_.faces[static_cast<std::size_t>(face)][static_cast<std::size_t>(corner)];
  }

  MeshData data_;
};

}  // namespace dspm
