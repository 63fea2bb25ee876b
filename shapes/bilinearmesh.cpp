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
#include "dspm/shapes/bilinearmesh.h"

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/plain_shape.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

struct PatchMesh {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;  // one per vertex, or none
  std::vector<Vec2> uvs;      // likewise
  std::vector<PatchCorners> patches;
};

class BilinearMesh final : public Shape {
 public:
  explicit BilinearMesh(PatchMesh mesh) : mesh_(std::move(mesh)) {}

  int primitive_count() const override { return static_cast<int>(mesh_.patches.size()); }
  Bounds3 bounds(int primitive) const override { return PatchSurface(view(), primitive).bounds(); }
  std::optional<PrimitiveHit> intersect(int primitive, const Ray& ray) const override {
    return PatchSurface(view(), primitive).intersect(ray);
  }
  SurfacePoint surface_point(int primitive, Vec2 uv) const override {
    return PatchSurface(view(), primitive).surface_point<SurfacePoint>(uv);
  }
  float area(int primitive) const override { return PatchSurface(view(), primitive).area(); }
  Vec2 sample_area(int primitive, Vec2 u) const override { return PatchSurface(view(), primitive).sample_area(u); }
  std::optional<Vec2> area_numbers(int primitive, const Vec3& p) const override {
    return PatchSurface(view(), primitive).area_numbers(p);
  }
  std::optional<PlainShape> plain() const override { return view(); }

 private:
  PatchMeshView view() const {
    const auto array = [](const auto& of_vertices) { return of_vertices.empty() ? nullptr : of_vertices.data(); };
    return {.vertices = mesh_.vertices.data(),
            .patches = mesh_.patches.data(),
            .normals = array(mesh_.normals),
            .uvs = array(mesh_.uvs),
            .vertex_count = mesh_.vertices.size(),
            .patch_count = mesh_.patches.size()};
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
