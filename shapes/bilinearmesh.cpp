// Shape "bilinearmesh" "point3 P" [-1 -1 0  1 -1 0  -1 1 0  1 1 0.5]
//
// Bilinear patches: quadrilaterals with straight edges, bent like a saddle if their corners are not in a plane. A
// patch's four vertices are its corners (u, v) = (0, 0), (1, 0), (0, 1), (1, 1). Its outside is the side to which
// dp/du x dp/dv points, or that of its normals.
//
// | parameter   | default | meaning |
// | ----------- | ------- | ------- |
// | indices     | 0 1 2 3 if P has four points | four indices into P per patch, from 0 |
// | P           | required | the vertices |
// | N           | none    | normals, one per vertex |
// | uv          | none    | texture coordinates, one per vertex; if there are none, u and v |
// | faceIndices | none    | one number per patch, which only pbrt's texture "ptex" uses |
// | emissionfilename | none | in pbrt, the picture by which points of a light are drawn; dspm uses the light's own |
//
// [Reshetov 2019, Cool Patches, in Ray Tracing Gems, ch. 8; Pharr, Jakob, Humphreys, Physically Based Rendering, 4th
// ed., 6.6]
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounding.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/bilinear_patch.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

/// A patch's corners, as indices: p00, p10, p01, p11.
using PatchCorners = std::array<int, 4>;

struct PatchMesh {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;  // one per vertex, or none
  std::vector<Vec2> uvs;      // likewise
  std::vector<PatchCorners> patches;
};

template <class T>
T interpolated(const std::vector<T>& values, const PatchCorners& corners, Vec2 uv) {
  const auto at = [&](std::size_t c) { return values[static_cast<std::size_t>(corners[c])]; };
  return (at(0) * (1 - uv.x) + at(1) * uv.x) * (1 - uv.y) + (at(2) * (1 - uv.x) + at(3) * uv.x) * uv.y;
}

class BilinearMesh final : public Shape {
 public:
  explicit BilinearMesh(PatchMesh mesh) : mesh_(std::move(mesh)) {}

  int primitive_count() const override { return static_cast<int>(mesh_.patches.size()); }

  Bounds3 bounds(int primitive) const override {
    Bounds3 b;
    for (const int v : corners(primitive)) b.add(vertex(v));
    return b;
  }

  std::optional<PrimitiveHit> intersect(int primitive, const Ray& ray) const override {
    return patch(primitive).intersect(ray);
  }

  SurfacePoint surface_point(int primitive, Vec2 uv) const override {
    const BilinearPatch p = patch(primitive);
    const Bounds3 box = bounds(primitive);
    const float size_error = gamma_bound(4) * max_component(box.high - box.low);
    SurfacePoint s;
    s.p = narrow(p.at(uv.x, uv.y));
    s.p_error = gamma_bound(2) * abs(s.p) + Vec3{size_error, size_error, size_error};
    s.ng = normal_of(p, uv);
    s.ns = s.ng;
    if (!mesh_.normals.empty()) {
      const Vec3 n = interpolated(mesh_.normals, corners(primitive), uv);
      if (dot(n, s.ng) < 0) s.ng = -s.ng;
      s.ns = length2(n) > 0 && dot(n, s.ng) > 0 ? normalize(n) : s.ng;
    }
    s.uv = mesh_.uvs.empty() ? uv : interpolated(mesh_.uvs, corners(primitive), uv);
    set_tangents(s, p, corners(primitive), uv);
    return s;
  }

  float area(int primitive) const override { return static_cast<float>(patch(primitive).area()); }

  Vec2 sample_area(int primitive, Vec2 u) const override {
    const auto uv = patch(primitive).uniform(u);
    return {static_cast<float>(uv[0]), static_cast<float>(uv[1])};
  }

  std::optional<Vec2> area_numbers(int primitive, const Vec3& p) const override {
    const BilinearPatch on = patch(primitive);
    const auto uv = on.parameters(p);
    if (!uv) return std::nullopt;
    const Vec2 numbers = on.uniform_numbers((*uv)[0], (*uv)[1]);
    return std::isfinite(numbers.x) && std::isfinite(numbers.y) ? std::optional(numbers) : std::nullopt;
  }

 private:
  const PatchCorners& corners(int primitive) const { return mesh_.patches[static_cast<std::size_t>(primitive)]; }
  const Vec3& vertex(int v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }
  BilinearPatch patch(int primitive) const {
    const PatchCorners& c = corners(primitive);
    return {vertex(c[0]), vertex(c[1]), vertex(c[2]), vertex(c[3])};
  }

  /// Returns the normal; in a corner or on an edge without one, that of the middle.
  static Vec3 normal_of(const BilinearPatch& p, Vec2 uv) {
    for (const Vec2 place : {uv, Vec2{0.5f, 0.5f}}) {
      const DoubleVec3 n = p.normal(place.x, place.y);
      if (length(n) > 0) return narrow(n * (1 / length(n)));
    }
    return {0, 0, 1};
  }

  /// Sets dp/ds along the first texture coordinate s; any tangent if there is none. The derivatives by texture
  /// coordinates are those by u and v times the inverse of the coordinates' own.
  void set_tangents(SurfacePoint& s, const BilinearPatch& p, const PatchCorners& c, Vec2 uv) const {
    const Vec3 by_u = narrow(p.along_u(uv.y)), by_v = narrow(p.along_v(uv.x));
    s.dpdu = by_u, s.dpdv = by_v;
    if (!mesh_.uvs.empty()) {
      const auto st = [&](std::size_t i) { return mesh_.uvs[static_cast<std::size_t>(c[i])]; };
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

  PatchMesh mesh_;
};

/// Returns the first fault, and the parameter to blame.
std::optional<std::pair<const char*, std::string>> fault_of(const PatchMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  if (mesh.patches.empty()) return std::pair{"indices", std::string("the mesh has no patches")};
  if (!mesh.normals.empty() && mesh.normals.size() != count)
    return std::pair{"N", fmt::format("{} normals for {} vertices", mesh.normals.size(), count)};
  if (!mesh.uvs.empty() && mesh.uvs.size() != count)
    return std::pair{"uv", fmt::format("{} texture coordinates for {} vertices", mesh.uvs.size(), count)};
  for (std::size_t i = 0; i < mesh.patches.size(); ++i)
    for (const int v : mesh.patches[i])
      if (v < 0 || static_cast<std::size_t>(v) >= count)
        return std::pair{"indices", fmt::format("patch {} refers to vertex {}, but the mesh has vertices 0 to {}", i, v,
                                                static_cast<long>(count) - 1)};
  for (std::size_t i = 0; i < count; ++i)
    if (!is_finite(mesh.vertices[i])) return std::pair{"P", fmt::format("vertex {} is not finite", i)};
  return std::nullopt;
}

void note_emission_picture(ParamReader& reader, const std::string& file) {
  if (!file.empty())
    reader.diagnostics().note(reader.where("emissionfilename"),
                              "points of a light are drawn by its own picture, without \"emissionfilename\"");
}

}  // namespace

std::vector<MadeShape> make_bilinearmesh(ParamReader& reader) {
  PatchMesh mesh;
  std::vector<int> indices = reader.integers("indices", "four vertex indices per patch");
  mesh.vertices = reader.points3("P", "the vertices");
  mesh.normals = reader.points3("N", "normals, one per vertex");
  mesh.uvs = reader.points2("uv", "texture coordinates, one per vertex");
  if (indices.empty() && mesh.vertices.size() == 4) indices = {0, 1, 2, 3};
  read_face_indices(reader, indices.size() / 4);
  const std::string picture =
      reader.text("emissionfilename", "", "without effect: points of a light are drawn by its own picture");
  reader.finish();

  if (indices.size() % 4 != 0)
    reader.error("indices", fmt::format("the number of indices, {}, is not a multiple of 4", indices.size()));
  note_emission_picture(reader, picture);
  for (std::size_t i = 0; i + 3 < indices.size(); i += 4)
    mesh.patches.push_back({indices[i], indices[i + 1], indices[i + 2], indices[i + 3]});
  std::vector<MadeShape> made;
  if (const auto fault = fault_of(mesh))
    reader.error(mesh.vertices.empty() ? "P" : fault->first, fault->second);
  else
    made.push_back({std::make_unique<BilinearMesh>(std::move(mesh)), std::nullopt});
  return made;
}

}  // namespace dspm
