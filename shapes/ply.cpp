#include "dspm/shapes/ply.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/shapes/ply_header.h"
#include "dspm/shapes/ply_numbers.h"
#include "dspm/shapes/polygons.h"
#include "dspm/shapes/vertex_colour.h"

namespace dspm {
namespace {

/// Converts a colour. Those of whole numbers are pictures' (sRGB), others linear.
float colour_of(double value, PlyType type, bool is_opacity) {
  const double most = type == PlyType::uint8 ? 255 : type == PlyType::uint16 ? 65535 : 0;
  if (most == 0) return static_cast<float>(value);
  const double c = value / most;
  return is_opacity ? static_cast<float>(c) : linear_of_srgb(c);
}

/// The meaning of a vertex's property.
enum Slot {
  kX,
  kY,
  kZ,
  kNx,
  kNy,
  kNz,
  kU,
  kV,
  kTx,
  kTy,
  kTz,
  kTw,
  kU2,
  kV2,
  kRed,
  kGreen,
  kBlue,
  kAlpha,
  kVx,
  kVy,
  kVz,
  kSlots,
  kNone = kSlots
};

Slot slot_of(const PlyProperty& property) {
  static constexpr std::pair<std::string_view, Slot> table[] = {
      {"x", kX},         {"y", kY},         {"z", kZ},           {"nx", kNx},         {"ny", kNy},
      {"nz", kNz},       {"u", kU},         {"v", kV},           {"s", kU},           {"t", kV},
      {"texture_u", kU}, {"texture_v", kV}, {"texture_s", kU},   {"texture_t", kV},   {"tx", kTx},
      {"ty", kTy},       {"tz", kTz},       {"tw", kTw},         {"u2", kU2},         {"v2", kV2},
      {"red", kRed},     {"green", kGreen}, {"blue", kBlue},     {"alpha", kAlpha},   {"vx", kVx},
      {"vy", kVy},       {"vz", kVz},       {"velocity_x", kVx}, {"velocity_y", kVy}, {"velocity_z", kVz}};
  for (const auto& [name, slot] : table)
    if (name == property.name && !property.is_list) return slot;
  return kNone;
}

/// Returns whether it holds vx, vy and vz.
bool is_velocity(const PlyProperty& property) { return property.is_list && property.name == "velocity"; }

bool is_corners(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

template <class Numbers>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, std::string_view body) : header_(header), numbers_(body) {}

  MeshData read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;  // takes no bytes, whatever its count
      std::uint64_t i = 0;
      try {
        begin(element);
        for (; i < element.count; ++i) read_one(element);
      } catch (const std::runtime_error& e) {
        throw std::runtime_error(fmt::format("{} (in \"{}\" {} of {})", e.what(), element.name, i, element.count));
      }
    }
    for (const int v : polygons_.corners) check(v);
    for (const Face& triangle : strips_)
      for (const int v : triangle) check(v);
    mesh_.faces = triangulate(polygons_, mesh_.vertices);
    mesh_.faces.insert(mesh_.faces.end(), strips_.begin(), strips_.end());
    return std::move(mesh_);
  }

 private:
  void begin(const PlyElement& element) {
    // An announced count is believed only as far as there are bytes for it.
    const std::size_t room = std::min<std::uint64_t>(element.count, numbers_.rest() / element.properties.size());
    if (element.name == "face") polygons_.ends.reserve(room);
    if (element.name != "vertex") return;
    slots_.clear();
    for (const PlyProperty& property : element.properties) slots_.push_back(slot_of(property));
    if (!has({kX, kY, kZ})) throw std::runtime_error("vertices have no x, y, z");
    has_normals_ = has({kNx, kNy, kNz});
    has_uvs_ = has({kU, kV});
    has_tangents_ = has({kTx, kTy, kTz}), has_signs_ = has_tangents_ && has({kTw}), has_second_uvs_ = has({kU2, kV2});
    has_colours_ = has({kRed, kGreen, kBlue}), has_opacities_ = has({kAlpha});
    has_velocities_ =
        has({kVx, kVy, kVz}) || std::any_of(element.properties.begin(), element.properties.end(), is_velocity);
    mesh_.vertices.reserve(room);
    mesh_.normals.reserve(has_normals_ ? room : 0);
    mesh_.uvs.reserve(has_uvs_ ? room : 0);
    mesh_.tangents.reserve(has_tangents_ ? room : 0);
    mesh_.turned.reserve(has_signs_ ? room : 0);
    mesh_.second_uvs.reserve(has_second_uvs_ ? room : 0);
    mesh_.colours.reserve(has_colours_ ? room : 0);
    mesh_.velocities.reserve(has_velocities_ ? room : 0);
  }

  bool has(std::initializer_list<Slot> slots) const {
    return std::all_of(slots.begin(), slots.end(),
                       [&](Slot s) { return std::find(slots_.begin(), slots_.end(), s) != slots_.end(); });
  }

  void read_one(const PlyElement& element) {
    if (element.name == "vertex")
      read_vertex(element);
    else if (element.name == "face")
      read_face(element);
    else if (element.name == "tristrips")
      read_strips(element);
    else
      for (const PlyProperty& property : element.properties) skip(property);
  }

  void read_vertex(const PlyElement& element) {
    float value[kSlots + 1] = {};
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (is_velocity(property))
        read_velocity(property, value);
      else if (property.is_list)
        skip(property);
      else if (const Slot slot = slots_[i]; slot >= kRed && slot <= kAlpha)
        value[slot] = colour_of(numbers_.next(property.type), property.type, slot == kAlpha);
      else
        value[slot] = static_cast<float>(numbers_.next(property.type));
    }
    mesh_.vertices.push_back({value[kX], value[kY], value[kZ]});
    if (has_normals_) mesh_.normals.push_back({value[kNx], value[kNy], value[kNz]});
    if (has_uvs_) mesh_.uvs.push_back({value[kU], value[kV]});
    if (has_tangents_) mesh_.tangents.push_back({value[kTx], value[kTy], value[kTz]});
    if (has_signs_) mesh_.turned.push_back(value[kTw] < 0);
    if (has_second_uvs_) mesh_.second_uvs.push_back({value[kU2], value[kV2]});
    if (has_colours_)
      mesh_.colours.push_back({value[kRed], value[kGreen], value[kBlue], has_opacities_ ? value[kAlpha] : 1});
    if (has_velocities_) mesh_.velocities.push_back({value[kVx], value[kVy], value[kVz]});
  }

  void read_velocity(const PlyProperty& property, float* value) {
    if (const std::uint64_t count = count_of(property); count != 3)
      throw std::runtime_error(fmt::format("a velocity of {} numbers, not 3", count));
    for (const Slot slot : {kVx, kVy, kVz}) value[slot] = static_cast<float>(numbers_.next(property.type));
  }

  void read_face(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (!is_corners(property)) {
        skip(property);
        continue;
      }
      for (std::uint64_t left = count_of(property); left > 0; --left)
        polygons_.add_corner(index(numbers_.next(property.type)));
      polygons_.close();
    }
  }

  /// Reads strips. Each corner makes a triangle of the two before it, whose outside is that of the strip's first; -1
  /// ends a strip. Corners that occur twice turn a corner and make none.
  void read_strips(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (!is_corners(property)) {
        skip(property);
        continue;
      }
      Face last{-1, -1, -1};
      bool is_even = false;
      for (std::uint64_t left = count_of(property); left > 0; --left) {
        const double corner = numbers_.next(property.type);
        if (corner == -1 || (property.type == PlyType::uint32 && corner == 4294967295.0)) {
          last = {-1, -1, -1};
          continue;
        }
        last = {last[1], last[2], index(corner)};
        is_even = last[1] < 0 || !is_even;
        const auto [a, b, c] = last;
        if (a < 0 || a == b || b == c || c == a) continue;
        strips_.push_back(is_even ? last : Face{b, a, c});
      }
    }
  }

  void check(int vertex) const {
    const auto count = static_cast<int>(mesh_.vertices.size());
    if (vertex >= count) throw std::runtime_error(fmt::format("a face refers to vertex {} of {}", vertex, count));
  }

  std::uint64_t count_of(const PlyProperty& property) {
    const double count = numbers_.next(property.count_type);
    if (!(count >= 0 && count <= 1e9)) throw std::runtime_error("this is not the count of a list");
    return static_cast<std::uint64_t>(count);
  }

  static int index(double v) {
    if (!(v >= 0 && v < 2147483648.0)) throw std::runtime_error(fmt::format("{} is not a vertex index", v));
    return static_cast<int>(v);
  }

  void skip(const PlyProperty& property) {
    for (std::uint64_t left = property.is_list ? count_of(property) : 1; left > 0; --left) numbers_.next(property.type);
  }

  const PlyHeader& header_;
  Numbers numbers_;
  std::vector<Slot> slots_;  // of the vertices' properties
  bool has_normals_ = false, has_uvs_ = false, has_tangents_ = false, has_signs_ = false, has_second_uvs_ = false;
  bool has_colours_ = false, has_opacities_ = false, has_velocities_ = false;
  Polygons polygons_;
  std::vector<Face> strips_;
  MeshData mesh_;
};

}  // namespace

MeshData read_ply(std::string_view file) {
  const PlyHeader header = read_ply_header(file);
  const std::string_view body = file.substr(header.size);
  switch (header.format) {
    case PlyFormat::ascii: return BodyReader<AsciiNumbers>(header, body).read();
    case PlyFormat::little_endian: return BodyReader<BinaryNumbers<false>>(header, body).read();
    case PlyFormat::big_endian: break;
  }
  return BodyReader<BinaryNumbers<true>>(header, body).read();
}

}  // namespace dspm
