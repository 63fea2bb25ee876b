// glTF files to test with: JSON with one buffer, whose views and accessors are added piece by piece.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace dspm::test {

inline std::string base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k > bytes.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63]);
  }
  return text;
}

class GltfFile {
 public:
  /// The number of a new accessor. `more`: further members of its JSON, such as `,"normalized":true`.
  template <class T>
  int add(const std::vector<T>& numbers, const char* type, int component, int width, const std::string& more = "") {
    views_ += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", views_.empty() ? "" : ",",
                          bytes_.size(), numbers.size() * sizeof(T));
    accessors_ += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                              accessors_.empty() ? "" : ",", count_, component,
                              static_cast<int>(numbers.size()) / width, type, more);
    const std::size_t at = bytes_.size();
    bytes_.resize((at + numbers.size() * sizeof(T) + 3) / 4 * 4);
    std::memcpy(bytes_.data() + at, numbers.data(), numbers.size() * sizeof(T));
    return count_++;
  }
  int add_floats(const std::vector<float>& numbers, const char* type, int width) {
    return add(numbers, type, 5126, width);
  }

  /// `rest`: the other members of the root.
  std::string text(const std::string& rest) const {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"data:;base64,{}"}}],"bufferViews":[{}],)"
        R"("accessors":[{}],{}}})",
        bytes_.size(), base64(bytes_), views_, accessors_, rest);
  }

 private:
  std::string bytes_, views_, accessors_;
  int count_ = 0;
};

/// A square of two triangles in the plane z = 0, from -1 to 1: accessors of positions, texture coordinates and indices.
struct Square {
  explicit Square(GltfFile& file)
      : positions(file.add_floats({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, "VEC3", 3)),
        uvs(file.add_floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2)),
        indices(file.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123, 1)) {}
  std::string primitive(const std::string& more = "") const {
    return fmt::format(R"({{"attributes":{{"POSITION":{},"TEXCOORD_0":{}}},"indices":{}{}}})", positions, uvs, indices,
                       more);
  }
  int positions, uvs, indices;
};

}  // namespace dspm::test
