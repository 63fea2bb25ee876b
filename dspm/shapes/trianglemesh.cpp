// Shape "trianglemesh" "integer indices" [0 1 2  0 2 3] "point3 P" [-1 0 -1  1 0 -1  1 0 1  -1 0 1]
//
// Triangles in the scene's text. A face is seen from outside where its vertices run counter-clockwise (in a
// right-handed system), or where the normals point to.
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
#include "dspm/params/params.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/shape.h"

namespace dspm {

std::vector<ShapePart> make_trianglemesh(ParamReader& reader) {
  reader.alias("st", "uv");
  MeshData mesh = read_triangles(reader);
  mesh.normals = reader.points3("N", "normals, one a vertex");
  mesh.uvs = reader.points2("uv", "texture coordinates, one a vertex");
  const bool repair = read_repair(reader);
  refuse_mesh_params(reader);
  reader.unsupported("S", "tangents of a mesh");
  reader.finish();
  return mesh_part(reader, std::move(mesh), repair);
}

}  // namespace dspm
