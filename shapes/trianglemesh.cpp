// Shape "trianglemesh" "integer indices" [0 1 2  0 2 3] "point3 P" [-1 0 -1  1 0 -1  1 0 1  -1 0 1]
//
// Triangles in the scene file. The outside of a face is the side from which its vertices run counter-clockwise (in a
// right-handed system), or the side to which its normals point.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | indices   | 0 1 2 if P has three points | three indices into P per triangle, from 0 |
// | P         | required | the vertices |
// | N         | none    | normals, one per vertex |
// | uv        | none    | texture coordinates, one per vertex (st is another name) |
// | S         | none    | tangents along u, one per vertex, for materials that are rough along one direction |
// | faceIndices | none  | one number per triangle, which only pbrt's texture "ptex" uses |
// | repair    | false   | repairs the mesh if it is not a closed surface: see mesh_repair.h |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 6.5]
#include "dspm/base/params/params.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/shape.h"

namespace dspm {

std::vector<MadeShape> make_trianglemesh(ParamReader& reader) {
  reader.alias("st", "uv");
  MeshData mesh = read_triangles(reader);
  mesh.normals = reader.points3("N", "normals, one per vertex");
  mesh.uvs = reader.points2("uv", "texture coordinates, one per vertex");
  const bool repair = read_repair(reader);
  mesh.tangents = reader.points3("S", "tangents along u, one per vertex");
  read_face_indices(reader, mesh.faces.size());
  reader.finish();
  return made_mesh(reader, std::move(mesh), repair);
}

}  // namespace dspm
