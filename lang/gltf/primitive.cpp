#include "dspm/lang/gltf/primitive.h"

#include <fmt/format.h>

#include <cmath>

#include "dspm/lang/gltf/draco.h"

namespace dspm::gltf {
namespace {

constexpr std::size_t kTriangles = 4, kFan = 6;  // between them, a strip
constexpr int kJointsEach = 4;

class Reader {
 public:
  Reader(const Document& document, const Value& primitive)
      : document_(document), primitive_(primitive), accessors_(document["accessors"].size()) {
    const Value compressed = primitive.extension("KHR_draco_mesh_compression");
    if (compressed.exists()) draco_ = decode_draco(document, compressed);
  }

  Primitive read() {
    Primitive p;
    p.positions = attribute("POSITION", 3);
    if (p.positions.count == 0) primitive_["attributes"].fail("there are no positions");
    const std::size_t count = p.positions.count;
    p.normals = attribute("NORMAL", 3, count), p.tangents = attribute("TANGENT", 4, count);
    p.uvs = attribute("TEXCOORD_0", 2, count), p.uvs2 = attribute("TEXCOORD_1", 2, count);
    p.colours = attribute("COLOR_0", 0, count);
    if (p.colours.count > 0 && p.colours.width != 3 && p.colours.width != 4)
      primitive_["attributes"]["COLOR_0"].fail("3 or 4 numbers are expected");
    read_joints(p);
    read_targets(p);
    read_faces(p);
    return p;
  }

 private:
  /// Reads an attribute. A `width` or `count` of 0 accepts any.
  Numbers attribute(const std::string& name, std::size_t width, std::size_t count = 0) const {
    if (draco_)
      if (const auto found = draco_->attributes.find(name); found != draco_->attributes.end())
        return checked(primitive_["attributes"][name], found->second, width, count);
    return of(primitive_["attributes"][name], width, count);
  }

  Numbers of(const Value& value, std::size_t width, std::size_t count) const {
    const auto accessor = value.index(accessors_);
    return accessor ? checked(value, numbers_of(document_, *accessor), width, count) : Numbers();
  }

  static Numbers checked(const Value& value, Numbers numbers, std::size_t width, std::size_t count) {
    if (width != 0 && numbers.width != width) value.fail(fmt::format("{} numbers to a vertex are expected", width));
    if (count != 0 && numbers.count != count)
      value.fail(fmt::format("{} elements for {} vertices", numbers.count, count));
    return numbers;
  }

  void read_joints(Primitive& p) const {
    for (int set = 0; set < 2; ++set) {
      Numbers joints = attribute(fmt::format("JOINTS_{}", set), kJointsEach, p.positions.count);
      Numbers weights = attribute(fmt::format("WEIGHTS_{}", set), kJointsEach, p.positions.count);
      if (joints.count == 0 || weights.count == 0) return;
      p.joints.push_back(std::move(joints)), p.weights.push_back(std::move(weights));
    }
  }

  void read_targets(Primitive& p) const {
    const Value targets = primitive_["targets"];
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const auto moved = [&](const char* name) { return of(targets[i][name], 3, p.positions.count); };
      p.targets.push_back({moved("POSITION"), moved("NORMAL"), moved("TANGENT")});
    }
  }

  void read_faces(Primitive& p) const {
    std::vector<std::uint32_t> corners;
    if (draco_)
      corners = draco_->corners;
    else if (const auto indices = primitive_["indices"].index(accessors_))
      corners = indices_of(document_, *indices);
    else
      for (std::uint32_t i = 0; i < p.positions.count; ++i) corners.push_back(i);
    for (const std::uint32_t corner : corners)
      if (corner >= p.positions.count)
        primitive_["indices"].fail(fmt::format("there is no vertex {}: there are {}", corner, p.positions.count));
    const std::size_t mode = draco_ ? kTriangles : primitive_["mode"].count(kTriangles);
    if (mode == kTriangles)
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        p.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    else
      for (std::size_t i = 0; i + 2 < corners.size(); ++i)
        p.faces.push_back(mode == kFan ? std::array{corners[0], corners[i + 1], corners[i + 2]}
                                       : std::array{corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    if (p.faces.empty()) primitive_.fail("it has no triangles");
  }

  const Document& document_;
  const Value primitive_;
  std::size_t accessors_;
  std::optional<DracoMesh> draco_;
};

void add(Numbers& to, const Numbers& moved, float weight) {
  if (to.count == 0 || moved.count == 0) return;
  for (std::size_t i = 0; i < to.count; ++i)
    for (std::size_t c = 0; c < 3; ++c) to.values[i * to.width + c] += weight * moved[i][c];
}

std::array<double, 3> applied(const Matrix4& m, const float* v, double w) {
  std::array<double, 3> result{};
  for (std::size_t row = 0; row < 3; ++row)
    result[row] = m.m[row][0] * v[0] + m.m[row][1] * v[1] + m.m[row][2] * v[2] + m.m[row][3] * w;
  return result;
}

/// Moves vertices by the weighted mean of the joints' matrices. Normals are moved as tangents are, which is close as
/// long as joints scale alike in all directions.
void move_by_joints(Primitive& p, const std::vector<Matrix4>& skin) {
  for (std::size_t i = 0; i < p.positions.count; ++i) {
    Matrix4 mean;
    mean.m = {};
    double sum = 0;
    for (std::size_t set = 0; set < p.joints.size(); ++set)
      for (std::size_t k = 0; k < kJointsEach; ++k) {
        const double weight = p.weights[set][i][k];
        const auto joint = static_cast<std::size_t>(std::max(p.joints[set][i][k], 0.f));
        if (!(weight > 0)) continue;
        if (joint >= skin.size())
          throw std::runtime_error(fmt::format("a vertex hangs on joint {} of {}", joint, skin.size()));
        sum += weight;
        for (std::size_t row = 0; row < 3; ++row)
          for (std::size_t column = 0; column < 4; ++column) mean.m[row][column] += weight * skin[joint].m[row][column];
      }
    if (!(sum > 0)) continue;
    for (auto& row : mean.m)
      for (double& value : row) value /= sum;
    const auto move = [&](Numbers& numbers, double w) {
      if (numbers.count == 0) return;
      const auto moved = applied(mean, numbers[i], w);
      for (std::size_t c = 0; c < 3; ++c) numbers.values[i * numbers.width + c] = static_cast<float>(moved[c]);
    };
    move(p.positions, 1), move(p.normals, 0), move(p.tangents, 0);
  }
}

Numbers elements_of(const Numbers& numbers, const std::vector<std::size_t>& chosen) {
  if (numbers.count == 0) return {};
  Numbers some{chosen.size(), numbers.width, {}};
  for (const std::size_t i : chosen) some.values.insert(some.values.end(), numbers[i], numbers[i] + numbers.width);
  return some;
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

}  // namespace

bool has_surface(const Value& primitive) {
  const std::size_t mode = primitive["mode"].count(kTriangles);
  if (mode > kFan) primitive["mode"].fail("no such mode");
  return mode >= kTriangles;
}

Primitive read_primitive(const Document& document, const Value& primitive) {
  return Reader(document, primitive).read();
}

Primitive vertices_of(const Primitive& p, const std::vector<std::size_t>& chosen) {
  Primitive some;
  some.positions = elements_of(p.positions, chosen);
  for (const Primitive::Target& target : p.targets)
    some.targets.push_back({elements_of(target.positions, chosen), {}, {}});
  for (const Numbers& joints : p.joints) some.joints.push_back(elements_of(joints, chosen));
  for (const Numbers& weights : p.weights) some.weights.push_back(elements_of(weights, chosen));
  return some;
}

void pose(Primitive& p, const std::vector<double>& weights, const std::vector<Matrix4>& skin) {
  for (std::size_t i = 0; i < std::min(weights.size(), p.targets.size()); ++i) {
    const auto weight = static_cast<float>(weights[i]);
    if (weight == 0) continue;
    add(p.positions, p.targets[i].positions, weight), add(p.normals, p.targets[i].normals, weight);
    add(p.tangents, p.targets[i].tangents, weight);
  }
  if (!skin.empty() && !p.joints.empty()) move_by_joints(p, skin);
}

std::string ply_of(const Primitive& p) {
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", p.positions.count);
  const auto declare = [&](const Numbers& numbers, std::initializer_list<const char*> names) {
    if (numbers.count > 0)
      for (const char* name : names) header += fmt::format("property float {}\n", name);
  };
  declare(p.positions, {"x", "y", "z"}), declare(p.normals, {"nx", "ny", "nz"}), declare(p.uvs, {"u", "v"});
  declare(p.tangents, {"tx", "ty", "tz", "tw"}), declare(p.uvs2, {"u2", "v2"}),
      declare(p.colours, {"red", "green", "blue"});
  if (p.has_opacities()) declare(p.colours, {"alpha"});
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", p.faces.size());

  std::string bytes = std::move(header);
  for (std::size_t i = 0; i < p.positions.count; ++i) {
    const auto write = [&](const Numbers& numbers, std::size_t count) {
      if (numbers.count > 0) append(bytes, numbers[i], count * sizeof(float));
    };
    const auto write_uv = [&](const Numbers& numbers) {
      if (numbers.count == 0) return;
      const float uv[2] = {numbers[i][0], 1 - numbers[i][1]};
      append(bytes, uv, sizeof uv);
    };
    write(p.positions, 3), write(p.normals, 3), write_uv(p.uvs), write(p.tangents, 4), write_uv(p.uvs2);
    write(p.colours, p.colours.width);
  }
  for (const auto& face : p.faces) {
    bytes.push_back(3);
    append(bytes, face.data(), sizeof face);
  }
  return bytes;
}

}  // namespace dspm::gltf
