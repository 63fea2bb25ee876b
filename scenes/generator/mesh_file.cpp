#include "scenes/generator/mesh_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>

#include "dspm/base/math/vec.h"
#include "dspm/base/system/atomic_file.h"

namespace dspm {
namespace {

std::string header(const MeshData& mesh, std::string_view index_type) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text +=
      fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n", mesh.vertices.size());
  if (!mesh.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uvs.empty()) text += "property float u\nproperty float v\n";
  text += fmt::format("element face {}\nproperty list uchar {} vertex_indices\n", mesh.faces.size(), index_type);
  return text + "end_header\n";
}

template <class T>
void append(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  const auto* begin = reinterpret_cast<const char*>(&value);
  bytes.append(begin, sizeof(T));
}

void append(std::string& bytes, const Vec3& v) {
  for (const float each : {v.x, v.y, v.z}) append(bytes, each);
}

template <class Index>
void append_faces(std::string& bytes, const std::vector<Face>& faces) {
  for (const Face& face : faces) {
    append(bytes, std::uint8_t{3});
    for (const int corner : face) append(bytes, static_cast<Index>(corner));
  }
}

}  // namespace

void write_ply(const std::filesystem::path& file, const MeshData& mesh) {
  const bool small = mesh.vertices.size() <= 65536;
  std::string bytes = header(mesh, small ? "ushort" : "int");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    append(bytes, mesh.vertices[i]);
    if (!mesh.normals.empty()) append(bytes, mesh.normals[i]);
    if (mesh.uvs.empty()) continue;
    append(bytes, mesh.uvs[i].x);
    append(bytes, mesh.uvs[i].y);
  }
  small ? append_faces<std::uint16_t>(bytes, mesh.faces) : append_faces<std::int32_t>(bytes, mesh.faces);
  write_file(file, bytes);
}

}  // namespace dspm
