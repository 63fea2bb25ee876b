#include "scenes/generator/modelling.h"

#include <cmath>

namespace dspm {
namespace {

/// The first vertices of a profile's rings; a ring on the axis has one vertex.
std::vector<int> add_rings(MeshData& mesh, const std::vector<Vec2>& profile, int sides) {
  std::vector<int> begins;
  for (const Vec2& p : profile) {
    begins.push_back(static_cast<int>(mesh.vertices.size()));
    for (int i = 0; i < (p.x > 0 ? sides : 1); ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(sides);
      mesh.vertices.push_back({p.x * std::cos(angle), p.y, p.x * std::sin(angle)});
    }
  }
  return begins;
}

}  // namespace

MeshData lathe(const std::vector<Vec2>& profile, int sides) {
  MeshData mesh;
  const std::vector<int> begins = add_rings(mesh, profile, sides);
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    const bool low_is_point = profile[ring].x <= 0, high_is_point = profile[ring + 1].x <= 0;
    for (int i = 0; i < sides; ++i) {
      const int next = (i + 1) % sides;
      const int low = begins[ring] + (low_is_point ? 0 : i), low_next = begins[ring] + (low_is_point ? 0 : next);
      const int high = begins[ring + 1] + (high_is_point ? 0 : i);
      const int high_next = begins[ring + 1] + (high_is_point ? 0 : next);
      if (!low_is_point) mesh.faces.push_back({low, high, low_next});
      if (!high_is_point) mesh.faces.push_back({high, high_next, low_next});
    }
  }
  return mesh;
}

void append(MeshData& mesh, const MeshData& part, const Transform& placement) {
  const int offset = static_cast<int>(mesh.vertices.size());
  const bool first = mesh.vertices.empty();
  const bool with_normals = (first || !mesh.normals.empty()) && !part.normals.empty();
  const bool with_uvs = (first || !mesh.uvs.empty()) && !part.uvs.empty();
  if (!with_normals) mesh.normals.clear();
  if (!with_uvs) mesh.uvs.clear();
  for (const Vec3& p : part.vertices) mesh.vertices.push_back(placement.point(p));
  if (with_normals)
    for (const Vec3& n : part.normals) mesh.normals.push_back(normalize(placement.normal(n)));
  if (with_uvs) mesh.uvs.insert(mesh.uvs.end(), part.uvs.begin(), part.uvs.end());
  const bool mirrored = placement.swaps_handedness();
  for (const Face& f : part.faces)
    mesh.faces.push_back({f[0] + offset, f[mirrored ? 2 : 1] + offset, f[mirrored ? 1 : 2] + offset});
}

}  // namespace dspm
