#include "dspm/shapes/deform.h"

#include <algorithm>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

constexpr std::int64_t kGrain = 4096;  // vertices

/// Normals may turn a face over, see TriangleMesh.
bool are_same(const Face& a, const Face& b) { return a == b || (a[0] == b[0] && a[1] == b[2] && a[2] == b[1]); }

Vec3 mix(const Vec3& a, const Vec3& b, double t) { return narrow(widen(a) * (1 - t) + widen(b) * t); }

/// Sets `own` to the mixtures, if there is one for each of its elements.
void take_mixed(std::vector<Vec3>& own, const std::vector<Vec3>& a, const std::vector<Vec3>& b, double t) {
  if (a.size() != own.size() || b.size() != own.size()) return;
  parallel_for(static_cast<std::int64_t>(own.size()), kGrain, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    own[at] = mix(a[at], b[at], t);
  });
}

}  // namespace

bool same_topology(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices().size() == b.vertices().size() &&
         std::equal(a.faces().begin(), a.faces().end(), b.faces().begin(), b.faces().end(), are_same);
}

TriangleMesh between(const TriangleMesh& own, const TriangleMesh& a, const TriangleMesh& b, double t) {
  MeshData mesh = own.data();
  mesh.velocities.clear();
  take_mixed(mesh.vertices, a.vertices(), b.vertices(), t);
  take_mixed(mesh.normals, a.normals(), b.normals(), t);
  take_mixed(mesh.tangents, a.tangents(), b.tangents(), t);
  return TriangleMesh(std::move(mesh));
}

TriangleMesh moved(const TriangleMesh& mesh, double time) {
  MeshData later = mesh.data();
  parallel_for(static_cast<std::int64_t>(later.vertices.size()), kGrain, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    later.vertices[at] = narrow(widen(later.vertices[at]) + widen(later.velocities[at]) * time);
  });
  later.velocities.clear();
  return TriangleMesh(std::move(later));
}

}  // namespace dspm
