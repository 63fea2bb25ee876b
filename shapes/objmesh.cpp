// Shape "objmesh" "string filename" "chair.obj" "string group" "seat"
//
// Triangles from a Wavefront OBJ file, with the materials of its MTL files. Faces of any number of corners, normals,
// texture coordinates, negative indices, colours of vertices (see the texture "vertexcolor"). In a Dynamic block `%03d`
// in the name stands for the frame's number; if a file of the sequence has no faces, the shape is not there.
//
// | parameter | default  | meaning |
// | --------- | -------- | ------- |
// | filename  | required | the file; may be gzip-compressed |
// | group     | ""       | only this group or object of the file; "": all |
// | materials | true     | use the file's materials; false: the scene's material |
// | repair    | false    | repairs the mesh if it is not a closed surface: see mesh_repair.h |
// | between   | linear   | while the shutter is open, vertices are on their way to the next file of a sequence; hold: they stay |
//
// Materials of MTL files: illum 4, 6, 7 and 9 are "dielectric" with Ni as eta (1.5 if there is none) and Pr^2 as GGX
// alpha, or with a Tf below 1 "principled" with transmission 1. Others are "principled" if they have Pr, Pm, Ps, Pc or
// aniso (with their pictures, Pcr and anisor), or a Ks and no illum 1: Ns is Phong's exponent, a Ks of a half mirrors
// as Ni says, map_Ks is its colour, and without Kd both are those of metal. The rest is "diffuse" of Kd or map_Kd. Ke
// and map_Ke are "emission", d (but of glass) and map_d are "alpha", and take "principled" as well. norm is a normal
// map, and so is map_Bump (bump) if it is a picture of normals; else its heights, times -bm, are in scene units, and so
// are those of disp. Options of pictures: -s and -o place them at s = scale u + offset, -clamp on, -mm with a base of
// 0, and -imfchan r, g or b of numbers; -bm of norm multiplies slopes; pictures of normals in map_Bump have none.
// -boost has no effect: it counters the blur of smaller versions of a picture, and here pictures get as sharp as they
// are. Everything else is left out, with one warning for each kind of statement. In files that begin with "# Blender",
// statements mean what Blender writes them for: Ns = 1000 (1 - roughness)^2, illum 3 and 6 are metal, as much as Ka
// says, 6 and 9 go with d and are no glass, and Tf is "transmission". The scene may use these materials by their names
// (NamedMaterial, in later shapes), variations may replace them and dim their lights, and a MakeNamedMaterial of the
// scene with the same name takes their place.
#include <algorithm>
#include <stdexcept>

#include "dspm/base/params/params.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/obj.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

std::optional<FileMaterial> material_of(const ObjMesh& mesh, const ObjFile& file, ParamReader& reader) {
  if (mesh.material.empty()) return std::nullopt;
  const auto found = std::find_if(file.materials.begin(), file.materials.end(),
                                  [&](const FileMaterial& m) { return m.name == mesh.material; });
  if (found != file.materials.end()) {
    FileMaterial material = *found;
    for (Param& param : material.params.params) param.where = param.values_where = reader.where("filename");
    return material;
  }
  reader.warning("filename",
                 fmt::format("the file's material \"{}\" is not defined: the scene's is used", mesh.material));
  return std::nullopt;
}

void report_unknown_group(ParamReader& reader, const ObjFile& file, const std::string& group) {
  constexpr std::size_t kMostNamed = 20;
  const auto end = file.groups.begin() + static_cast<std::ptrdiff_t>(std::min(kMostNamed, file.groups.size()));
  reader.error("group", fmt::format("the file has no group or object \"{}\"", group),
               fmt::format("{} available: {}{}", did_you_mean(group, file.groups),
                           fmt::join(file.groups.begin(), end, ", "), end == file.groups.end() ? "" : ", ..."));
}

}  // namespace

std::vector<MadeShape> make_objmesh(ParamReader& reader) {
  const std::filesystem::path path = reader.file("filename", "the OBJ file");
  const std::string group = reader.text("group", "", "only this group or object of the file");
  const bool materials = reader.flag("materials", true, "use the materials of the file's MTL files");
  const bool repair = read_repair(reader);
  read_between(reader);
  reader.finish();

  std::vector<MadeShape> made;
  if (path.empty()) return made;
  try {
    ObjFile file = read_obj(path, group, materials);
    if (materials)
      for (const std::string& complaint : file.complaints) reader.warning("filename", complaint);
    if (file.meshes.empty() && file.has_faces) report_unknown_group(reader, file, group);
    for (ObjMesh& mesh : file.meshes) {
      std::optional<FileMaterial> material = material_of(mesh, file, reader);
      made.push_back({std::make_unique<TriangleMesh>(std::move(mesh.mesh)), std::move(material), repair});
    }
  } catch (const std::exception& e) {
    report_bad_file(reader, path, e);
  }
  return made;
}

}  // namespace dspm
