// Shape "plymesh" "string filename" "horse.ply"
//
// A mesh from a PLY file: ASCII or binary, gzip-compressed or not; polygons become triangles; normals (nx, ny, nz) and
// texture coordinates (u v, s t, texture_u texture_v, texture_s texture_t) are used if present.
//
// | parameter | default  | meaning |
// | --------- | -------- | ------- |
// | filename  | required | the file |
// | repair    | false    | repairs the mesh if it is not a closed surface: see mesh_repair.h |
//
// In a Dynamic block `%03d` in the name stands for the frame's number. [Turk 1994, The PLY Polygon File Format]
#include <stdexcept>

#include "dspm/params/params.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/ply.h"
#include "dspm/shapes/shape.h"
#include "dspm/system/read_file.h"

namespace dspm {

std::vector<MadeShape> make_plymesh(ParamReader& reader) {
  const std::filesystem::path path = reader.file("filename", "the PLY file");
  const bool repair = read_repair(reader);
  refuse_mesh_params(reader);
  reader.finish();

  std::vector<MadeShape> made;
  if (path.empty()) return made;
  try {
    made.push_back({std::make_unique<TriangleMesh>(read_ply(read_file(path))), std::nullopt, repair});
  } catch (const std::exception& e) {
    report_bad_file(reader, path, e);
  }
  return made;
}

}  // namespace dspm
