#include "scenes/generator/modelling.h"

#include <cmath>
#include <map>
#include <tuple>

#include "dspm/base/math/vec.h"

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

MeshData sweep(const std::vector<Vec2>& profile, const std::vector<Vec3>& path, const Vec3& side, bool loop) {
  MeshData mesh;
  const int steps = static_cast<int>(path.size()), corners = static_cast<int>(profile.size());
  const auto point = [&](int i) { return path[static_cast<std::size_t>((i + steps) % steps)]; };
  for (int i = 0; i < steps; ++i) {
    const Vec3 before = i > 0 || loop ? point(i) - point(i - 1) : point(1) - point(0);
    const Vec3 after = i + 1 < steps || loop ? point(i + 1) - point(i) : before;
    const Vec3 across = normalize(cross(normalize(before) + normalize(after), side));
    for (const Vec2& p : profile) mesh.vertices.push_back(point(i) + side * p.x + across * p.y);
  }
  for (int i = 0; i + (loop ? 0 : 1) < steps; ++i)
    for (int k = 0; k < corners; ++k) {
      const int near = i * corners, far = (i + 1) % steps * corners, next = (k + 1) % corners;
      mesh.faces.push_back({near + k, near + next, far + k});
      mesh.faces.push_back({near + next, far + next, far + k});
    }
  return mesh;
}

std::vector<Vec2> ellipse(float radius_x, float radius_y, int corners) {
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(corners);
    points.push_back({radius_x * std::cos(angle), radius_y * std::sin(angle)});
  }
  return points;
}

MeshData box(const Vec3& low, const Vec3& high) {
  MeshData mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  mesh.faces = {{0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}};
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

MeshData with_normals(const MeshData& mesh, float crease_degrees) {
  const float cosine = std::cos(crease_degrees * kPi / 180);
  std::vector<Vec3> face_normals;  // each as long as twice the face's area
  std::vector<std::vector<int>> faces_at(mesh.vertices.size());
  for (const Face& face : mesh.faces) {
    const auto corner = [&](int i) {
      return mesh.vertices[static_cast<std::size_t>(face[static_cast<std::size_t>(i)])];
    };
    for (const int v : face) faces_at[static_cast<std::size_t>(v)].push_back(static_cast<int>(face_normals.size()));
    face_normals.push_back(cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  MeshData result;
  std::map<std::tuple<int, float, float, float>, int> made;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 own = normalize(face_normals[f]);
    Face face{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = mesh.faces[f][k];
      Vec3 sum;
      for (const int other : faces_at[static_cast<std::size_t>(v)]) {
        const Vec3 n = face_normals[static_cast<std::size_t>(other)];
        if (dot(n, own) >= cosine * length(n)) sum += n;
      }
      const Vec3 normal = normalize(sum);
      const auto [place, is_new] =
          made.try_emplace({v, normal.x, normal.y, normal.z}, static_cast<int>(result.vertices.size()));
      if (is_new) {
        result.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
        result.normals.push_back(normal);
        if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[static_cast<std::size_t>(v)]);
      }
      face[k] = place->second;
    }
    result.faces.push_back(face);
  }
  return result;
}

}  // namespace dspm
