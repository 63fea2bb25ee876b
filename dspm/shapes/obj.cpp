#include "dspm/shapes/obj.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <span>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "dspm/math/vec.h"
#include "dspm/shapes/obj_check.h"
#include "dspm/shapes/polygons.h"
#include "dspm/system/file_access.h"
#include "dspm/system/read_file.h"

namespace dspm {
namespace {

/// A corner's indices from 0; -1: none.
struct Corner {
  int vertex, uv, normal;
  friend bool operator==(const Corner&, const Corner&) = default;
};
struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::uint64_t h = 0;
    for (const int i : {c.vertex, c.uv, c.normal}) h = (h ^ static_cast<std::uint32_t>(i)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
};

/// The file's vertex data, to which all faces refer.
struct Attributes {
  std::vector<Vec3> vertices, normals;
  std::vector<Vec2> uvs;
};

/// The faces of one material while the file is read.
struct Faces {
  std::string material;
  std::vector<Corner> corners;
  std::vector<std::size_t> ends;

  /// One vertex for every distinct corner.
  MeshData mesh(const Attributes& attributes) const {
    const auto any = [&](int Corner::*index) {
      return std::any_of(corners.begin(), corners.end(), [&](const Corner& c) { return c.*index >= 0; });
    };
    const bool has_normals = any(&Corner::normal), has_uvs = any(&Corner::uv);
    MeshData mesh;
    Polygons polygons;
    polygons.ends = ends;
    std::unordered_map<Corner, int, CornerHash> numbers;
    for (const Corner& c : corners) {
      const auto [it, added] = numbers.try_emplace(c, static_cast<int>(mesh.vertices.size()));
      polygons.add_corner(it->second);
      if (!added) continue;
      mesh.vertices.push_back(attributes.vertices[static_cast<std::size_t>(c.vertex)]);
      if (has_normals)
        mesh.normals.push_back(c.normal < 0 ? Vec3{} : attributes.normals[static_cast<std::size_t>(c.normal)]);
      if (has_uvs) mesh.uvs.push_back(c.uv < 0 ? Vec2{} : attributes.uvs[static_cast<std::size_t>(c.uv)]);
    }
    mesh.faces = triangulate(polygons, mesh.vertices);
    return mesh;
  }
};

/// Hands material files to read_mtl, with their names.
class MaterialFiles : public tinyobj::MaterialReader {
 public:
  MaterialFiles(const std::filesystem::path& directory, const ObjCompanion& companion, ObjFile& out)
      : directory_(directory), companion_(companion), out_(out) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>*, std::map<std::string, int>*, std::string*,
                  std::string*) override {
    if (const std::optional<std::string> text = companion_(name))
      for (FileMaterial& material : read_mtl(*text, directory_ / name, out_.complaints, left_out_))
        out_.materials.push_back(std::move(material));
    else
      out_.complaints.push_back(fmt::format("there is no material file \"{}\"", name));
    return true;  // it has been handled
  }

  void complain_of_what_is_left_out() {
    for (std::string& sentence : in_words(left_out_)) out_.complaints.push_back(std::move(sentence));
  }

 private:
  const std::filesystem::path& directory_;
  const ObjCompanion& companion_;
  ObjFile& out_;
  MtlLeftOut left_out_;
};

/// Collects the data of tinyobjloader's callbacks. Faces are resolved at the end: they may come before their vertices.
class Collector {
 public:
  Collector(const std::string& group, bool split, ObjFile& out) : group_(group), split_(split), out_(out) {}

  static tinyobj::callback_t callbacks() {
    tinyobj::callback_t c;
    c.vertex_cb = [](void* self, float x, float y, float z, float) {
      at(self).attributes_.vertices.push_back({x, y, z});
    };
    c.normal_cb = [](void* self, float x, float y, float z) { at(self).attributes_.normals.push_back({x, y, z}); };
    c.texcoord_cb = [](void* self, float u, float v, float) { at(self).attributes_.uvs.push_back({u, v}); };
    c.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
      at(self).add_face({corners, static_cast<std::size_t>(count)});
    };
    c.usemtl_cb = [](void* self, const char* name, int) { at(self).material_ = trimmed(name); };
    c.group_cb = [](void* self, const char** names, int count) { at(self).groups_.assign(names, names + count); };
    c.object_cb = [](void* self, const char* name) {
      at(self).object_ = trimmed(name);
      at(self).groups_.clear();
    };
    return c;
  }

  void finish() {
    for (Faces& f : faces_) {
      for (const Corner& c : f.corners) check(c);
      out_.meshes.push_back({f.material, f.mesh(attributes_)});
    }
  }

 private:
  static Collector& at(void* self) { return *static_cast<Collector*>(self); }

  void add_face(std::span<const tinyobj::index_t> corners) {
    if (corners.size() < 3) return;
    if (!object_.empty()) note_name(object_);
    for (const std::string& name : groups_) note_name(name);
    const bool wanted =
        group_.empty() || object_ == group_ || std::find(groups_.begin(), groups_.end(), group_) != groups_.end();
    if (!wanted) return;
    Faces& faces = faces_of(split_ ? material_ : std::string());
    for (const tinyobj::index_t& c : corners)
      faces.corners.push_back({absolute(c.vertex_index, attributes_.vertices.size()),
                               absolute(c.texcoord_index, attributes_.uvs.size()),
                               absolute(c.normal_index, attributes_.normals.size())});
    faces.ends.push_back(faces.corners.size());
  }

  // From OBJ's indices: counted from 1, or backwards from -1 for the last one read so far; 0 if there is none.
  static int absolute(int index, std::size_t so_far) {
    if (index > 0) return index - 1;
    return index < 0 ? std::max(static_cast<int>(so_far) + index, -1) : -1;
  }

  void check(const Corner& c) const {
    const auto within = [&](int i, std::size_t size) { return i < 0 || static_cast<std::size_t>(i) < size; };
    if (c.vertex < 0 || !within(c.vertex, attributes_.vertices.size()))
      throw std::runtime_error(
          fmt::format("a face refers to vertex {} of {}", c.vertex + 1, attributes_.vertices.size()));
    if (!within(c.uv, attributes_.uvs.size()) || !within(c.normal, attributes_.normals.size()))
      throw std::runtime_error("a face refers to a normal or texture coordinate that does not exist");
  }

  void note_name(const std::string& name) {
    if (std::find(out_.groups.begin(), out_.groups.end(), name) == out_.groups.end()) out_.groups.push_back(name);
  }

  Faces& faces_of(const std::string& material) {
    const auto found =
        std::find_if(faces_.begin(), faces_.end(), [&](const Faces& f) { return f.material == material; });
    if (found != faces_.end()) return *found;
    return faces_.emplace_back(Faces{material, {}, {}});
  }

  const std::string& group_;
  bool split_;
  ObjFile& out_;
  Attributes attributes_;
  std::vector<Faces> faces_;
  std::string material_, object_;
  std::vector<std::string> groups_;
};

}  // namespace

ObjFile read_obj(const std::filesystem::path& path, const std::string& group, bool split) {
  const std::filesystem::path directory = path.parent_path();
  const auto companion = [&](const std::string& name) -> std::optional<std::string> {
    if (!seems_to_exist(directory / name)) return std::nullopt;
    return read_file(directory / name);
  };
  return parse_obj(read_file(path), directory, companion, group, split);
}

ObjFile parse_obj(const std::string& text, const std::filesystem::path& directory, const ObjCompanion& companion,
                  const std::string& group, bool split) {
  check_obj_numbers(text);
  std::istringstream lines(text);
  ObjFile out;
  MaterialFiles mtl(directory, companion, out);
  Collector collector(group, split, out);
  std::string warning, error;
  if (!tinyobj::LoadObjWithCallback(lines, Collector::callbacks(), &collector, &mtl, &warning, &error))
    throw std::runtime_error(error.empty() ? "it is not an OBJ file" : error);
  mtl.complain_of_what_is_left_out();
  collector.finish();
  return out;
}

}  // namespace dspm
