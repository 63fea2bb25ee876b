#include "dspm/shapes/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "dspm/base/math/vec.h"
#include "dspm/base/system/file_access.h"
#include "dspm/base/system/plain_text.h"
#include "dspm/base/system/read_file.h"
#include "dspm/shapes/mtl_files.h"
#include "dspm/shapes/obj_statements.h"
#include "dspm/shapes/polygons.h"
#include "dspm/shapes/vertex_colour.h"

namespace dspm {
namespace {

/// A corner's indices from 0; -1 if there is none.
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
  std::vector<Vec3> colours;  // as written, of the first vertices; none is white

  void colour_last(const Vec3& colour) {
    colours.resize(vertices.size() - 1, {1, 1, 1});
    colours.push_back(colour);
  }
  /// Converts colours, which programs write in sRGB, in 0..1 or in bytes.
  void settle_colours() {
    float most = 1;
    for (const Vec3& c : colours) most = std::max({most, c.x, c.y, c.z});
    const double unit = most > 1 ? 255 : 1;
    for (Vec3& c : colours)
      for (int i = 0; i < 3; ++i) c[i] = linear_of_srgb(std::max(c[i], 0.f) / unit);
    if (!colours.empty()) colours.resize(vertices.size(), {1, 1, 1});
  }
};

/// The faces of one material while the file is read.
struct Faces {
  std::string material;
  std::vector<Corner> corners;
  std::vector<std::size_t> ends;

  /// Makes one vertex for every distinct corner.
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
      if (const auto& all = attributes.colours; !all.empty()) {
        const Vec3& colour = all[static_cast<std::size_t>(c.vertex)];
        mesh.colours.push_back({colour.x, colour.y, colour.z, 1});
      }
      if (has_uvs) mesh.uvs.push_back(c.uv < 0 ? Vec2{} : attributes.uvs[static_cast<std::size_t>(c.uv)]);
    }
    mesh.faces = triangulate(polygons, mesh.vertices);
    return mesh;
  }
};

constexpr std::size_t kMostShown = 60;

[[noreturn]] void fail(const ObjStatement& at, const std::string& why) {
  throw std::runtime_error(fmt::format("line {}: {}: {}", at.line, at.text.substr(0, kMostShown), why));
}

/// Reads 7, 7/1, 7//3 or 7/1/3: indices as they are written; 0 if there is none.
std::optional<Corner> corner_of(std::string_view word) {
  int indices[3] = {0, 0, 0};
  for (int& index : indices) {
    const bool is_first = &index == indices;
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    const auto used = static_cast<std::size_t>(stop - word.data());
    if (error != std::errc() && (is_first || used > 0 || error == std::errc::result_out_of_range)) return std::nullopt;
    word.remove_prefix(used);
    if (word.empty()) return Corner{indices[0], indices[1], indices[2]};
    if (word.front() != '/') return std::nullopt;
    word.remove_prefix(1);
  }
  return std::nullopt;
}

/// Reads a file. Faces are resolved at the end: they may come before their vertices.
class ObjReader {
 public:
  ObjReader(const std::string& group, bool split, MtlFiles& libraries, ObjFile& out)
      : group_(group), split_(split), libraries_(libraries), out_(out) {}

  void read(std::string_view text) {
    ObjStatements statements(text);
    while (const auto statement = statements.next()) take(*statement);
    finish();
  }

 private:
  void take(const ObjStatement& s) {
    if (s.keyword == "v") {
      const auto v = numbers(s, 3);
      attributes_.vertices.push_back({v[0], v[1], v[2]});
      if (v.size() >= 6) attributes_.colour_last({v[3], v[4], v[5]});
    } else if (s.keyword == "vn") {
      const auto v = numbers(s, 3);
      attributes_.normals.push_back({v[0], v[1], v[2]});
    } else if (s.keyword == "vt") {
      const auto v = numbers(s, 1);
      attributes_.uvs.push_back({v[0], v.size() > 1 ? v[1] : 0});
    } else if (s.keyword == "f" || s.keyword == "fo") {
      add_face(s);
    } else if (s.keyword == "usemtl") {
      material_ = name_of_material(s.rest);
    } else if (s.keyword == "mtllib") {
      libraries_.read_named(s.rest);
    } else if (s.keyword == "o") {
      object_ = s.rest;
      groups_.clear();
    } else if (s.keyword == "g") {
      std::string_view rest = s.rest;
      groups_.clear();
      for (std::string_view name = next_word(rest); !name.empty(); name = next_word(rest)) groups_.emplace_back(name);
    } else if (s.keyword == "surf" && !std::exchange(has_free_forms_, true)) {
      out_.complaints.emplace_back("its free-form surfaces (surf) are left out");
    }
  }

  std::span<const float> numbers(const ObjStatement& s, std::size_t least) {
    numbers_.clear();
    std::string_view rest = s.rest;
    for (std::string_view word = next_value(rest); !word.empty(); word = next_value(rest)) {
      const std::optional<float> number = obj_number(word);
      if (!number) fail(s, fmt::format("\"{}\" is not a number", word.substr(0, kMostShown)));
      numbers_.push_back(*number);
    }
    if (numbers_.size() < least) fail(s, fmt::format("{} of {} numbers", numbers_.size(), least));
    return numbers_;
  }

  void add_face(const ObjStatement& s) {
    corners_.clear();
    std::string_view rest = s.rest;
    for (std::string_view word = next_value(rest); !word.empty(); word = next_value(rest)) {
      const std::optional<Corner> corner = corner_of(word);
      if (!corner) fail(s, fmt::format("\"{}\" is not a vertex of a face", word.substr(0, kMostShown)));
      corners_.push_back(*corner);
    }
    if (corners_.empty()) fail(s, "0 of 3 vertices");
    if (corners_.size() < 3) return;
    out_.has_faces = true;
    if (!object_.empty()) note_name(object_);
    for (const std::string& name : groups_) note_name(name);
    const bool wanted =
        group_.empty() || object_ == group_ || std::find(groups_.begin(), groups_.end(), group_) != groups_.end();
    if (!wanted) return;
    Faces& faces = faces_of(split_ ? material_ : std::string());
    for (const Corner& c : corners_)
      faces.corners.push_back({absolute(c.vertex, attributes_.vertices.size()), absolute(c.uv, attributes_.uvs.size()),
                               absolute(c.normal, attributes_.normals.size())});
    faces.ends.push_back(faces.corners.size());
  }

  void finish() {
    attributes_.settle_colours();
    for (Faces& f : faces_) {
      for (const Corner& c : f.corners) check(c);
      out_.meshes.push_back({f.material, f.mesh(attributes_)});
    }
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

  /// Returns the name of a material, which may have a # in it: what follows one is a comment only if no material has
  /// the whole name.
  std::string name_of_material(std::string_view written) const {
    const auto is_known = [&](std::string_view name) {
      return std::any_of(out_.materials.begin(), out_.materials.end(),
                         [&](const FileMaterial& m) { return m.name == name; });
    };
    std::string_view name = written;
    if (const std::size_t comment = written.find(" #"); comment != written.npos && !is_known(written))
      if (const std::string short_name = trimmed(written.substr(0, comment)); is_known(short_name)) return short_name;
    return std::string(name);
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
  MtlFiles& libraries_;
  ObjFile& out_;
  Attributes attributes_;
  std::vector<Faces> faces_;
  std::string material_, object_;
  std::vector<std::string> groups_;
  bool has_free_forms_ = false;
  std::vector<float> numbers_;   // of one statement
  std::vector<Corner> corners_;  // likewise, with indices as they are written
};

}  // namespace

ObjFile read_obj(const std::filesystem::path& path, const std::string& group, bool split) {
  const std::filesystem::path directory = path.parent_path();
  const auto companion = [&](const std::string& name) -> std::optional<std::string> {
    if (!seems_to_exist(directory / name)) return std::nullopt;
    return read_file(directory / name);
  };
  return parse_obj(read_text(path), directory, companion, group, split);
}

ObjFile parse_obj(const std::string& text, const std::filesystem::path& directory, const ObjCompanion& companion,
                  const std::string& group, bool split) {
  ObjFile out;
  MtlFiles libraries(directory, companion, out);
  ObjReader(group, split, libraries, out).read(text);
  libraries.complain_of_what_is_left_out();
  return out;
}

}  // namespace dspm
