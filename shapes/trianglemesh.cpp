// Shape "trianglemesh" "integer indices" [0 1 2  0 2 3] "point3 P" [-1 0 -1  1 0 -1  1 0 1  -1 0 1]
//
// Triangles in the scene's text. A face is seen from outside where its vertices run counter-clockwise (in a right-handed
// system), or where the normals point to.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | indices   | 0 1 2 where P has three points | three indices into P a triangle, from 0 |
// | P         | required | the vertices |
// | N         | none    | normals, one a vertex |
// | uv        | none    | texture coordinates, one a vertex (st is another name) |
// | repair    | false   | mends the mesh where it is no closed surface: see mesh_repair.h |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 6.5]
#include "shapes/mesh_params.h"
#include "shapes/plugins.h"
#include "shapes/triangle_mesh.h"

namespace dspm {

std::vector<ShapePart> make_trianglemesh(ParamReader& reader) {
  MeshData mesh;
  reader.alias("st", "uv");
  std::vector<int> indices = reader.integers("indices", "three indices of vertices a triangle");
  mesh.vertices = reader.points3("P", "the vertices");
  mesh.normals = reader.points3("N", "normals, one a vertex");
  mesh.uvs = reader.points2("uv", "texture coordinates, one a vertex");
  const bool repair = read_repair(reader);
  refuse_mesh_params(reader);
  reader.unsupported("S", "tangents of a mesh");
  reader.finish();

  std::vector<ShapePart> parts;
  if (indices.empty() && mesh.vertices.size() == 3) indices = {0, 1, 2};
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    mesh.faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
  const auto fault = fault_of(mesh);
  if (indices.size() % 3 != 0)
    reader.error("indices", fmt::format("{} indices do not make triangles", indices.size()));
  else if (fault)
    reader.error(mesh.vertices.empty() ? "P" : "indices", *fault);
  else
    parts.push_back({std::make_unique<TriangleMesh>(std::move(mesh)), std::nullopt, repair});
  return parts;
}

}  // namespace dspm
