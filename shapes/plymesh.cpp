// Shape "plymesh" "string filename" "horse.ply"
//
// A mesh from a PLY file: ASCII or binary, gzip-compressed or not; polygons become triangles; normals (nx, ny, nz) and
// texture coordinates (u v, s t, texture_u texture_v, texture_s texture_t) are used if present.
//
// | parameter | default  | meaning |
// | --------- | -------- | ------- |
// | filename  | required | the file |
// | displacement | 0 | moves the surface along its normals by that distance or texture, see displace.h; the file must have texture coordinates |
// | edgelength | 1 | of a displaced mesh: triangles are split until no edge is longer, in the world |
// | extent    | none     | two corners of a box that holds all meshes of a sequence, also where velocities take them: those of frames that are not rendered are not read |
// | between   | linear   | while the shutter is open, vertices are on their way to the next file of a sequence; hold: they stay |
// | velocityscale | 1    | multiplies the velocities of vertices; 0 in .pbrt files |
// | repair    | false    | repairs the mesh if it is not a closed surface: see mesh_repair.h |
//
// In a Dynamic block `%03d` in the name stands for the frame's number; if a file of the sequence has no faces, the
// shape is not there. While the shutter is open, vertices with velocities (vx vy vz, velocity_x velocity_y velocity_z, or
// a list velocity) move along them: by one a second if `Frames` gives fps, else by one a frame. [Turk 1994, The PLY Polygon File Format]
#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/read_file.h"
#include "dspm/shapes/mesh_extent.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/ply.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

/// Returns nullopt if none is given, or after an error.
std::optional<Bounds3> read_extent(ParamReader& reader) {
  const std::vector<Vec3> corners =
      reader.points3(kExtentParam,
                     "two corners of a box, in the mesh's own space, that holds every mesh of a sequence: those of "
                     "frames that are not rendered are not read");
  if (corners.empty()) return std::nullopt;
  Bounds3 box;
  for (const Vec3& corner : corners) box.add(corner);
  if (corners.size() == 2) return box;
  reader.error(kExtentParam, fmt::format("two corners of a box are expected, not {}", corners.size()));
  return std::nullopt;
}

}  // namespace

std::vector<MadeShape> make_plymesh(ParamReader& reader) {
  const std::filesystem::path path = reader.file("filename", "the PLY file");
  const Displacement displacement{
      reader.number_or_texture("displacement", 0, "", "moves the surface along its normals"),
      reader.number("edgelength", 1, "scene units", "the longest edge if it is displaced")};
  const bool displaces = reader.has("displacement");
  const bool repair = read_repair(reader);
  const std::optional<Bounds3> extent = read_extent(reader);
  read_between(reader);
  reader.number(kVelocityScaleParam, 1, "", "multiplies the velocities of vertices; 0 in .pbrt files");
  reader.finish();

  std::vector<MadeShape> made;
  if (!(displacement.edge_length > 0)) reader.error("edgelength", "\"edgelength\" must be above 0");
  if (path.empty()) return made;
  try {
    MeshData data = read_ply(read_file(path));
    if (data.faces.empty()) return made;
    if (extent && !holds(*extent, data.vertices)) {
      reader.error(kExtentParam, fmt::format("{} goes beyond this box", path.string()));
      return made;
    }
    MadeShape& mesh = made.emplace_back();
    mesh.shape = std::make_unique<TriangleMesh>(std::move(data));
    mesh.repair = repair;
    if (displaces) mesh.displacement = displacement;
  } catch (const std::exception& e) {
    made.clear();
    report_bad_file(reader, path, e);
  }
  return made;
}

}  // namespace dspm
