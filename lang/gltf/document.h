// A glTF 2.0 file as it is: its JSON, and the bytes of its buffers and pictures.
// [Khronos, glTF 2.0 Specification, ISO/IEC 12113:2022]
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/lang/gltf/value.h"

namespace dspm::gltf {

/// A run of elements, between which there may be other bytes.
struct View {
  std::string_view bytes;
  std::size_t stride = 0;  // 0: tightly packed
};

class Document {
 public:
  /// Reads a .gltf or .glb file. Throws std::runtime_error with a sentence that does not name the file.
  explicit Document(const std::filesystem::path& path);
  /// Reads bytes that are already there.
  Document(const std::filesystem::path& path, std::string file);

  Value root() const { return {&json_, ""}; }
  Value operator[](const std::string& key) const { return root()[key]; }
  const std::filesystem::path& path() const { return path_; }
  const Json& json() const { return json_; }
  /// The bytes of the file and its buffers, by which hostile counts are bounded.
  std::size_t bytes() const { return bytes_; }

  /// Returns bufferViews/index, expanded if it is compressed.
  View view(std::size_t index) const;
  /// Returns images/index, in a format of its own.
  std::string picture(std::size_t index) const;
  /// Returns ".png", ".jpg", ...
  std::string extension_of_picture(std::size_t index) const;

 private:
  struct Buffer {
    std::string bytes;
    std::string missing;  // why it could not be read, if nothing but a view that has another source needs it
  };
  void read_container(std::string file);
  void check_version() const;
  void read_buffers();
  std::string_view slice(const Value& view) const;
  std::string resource(const std::string& uri) const;

  std::filesystem::path path_;
  Json json_;
  std::string binary_;  // of a .glb
  std::vector<Buffer> buffers_;
  std::size_t bytes_ = 0;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<std::string>> expanded_;  // by view
};

}  // namespace dspm::gltf
