#include "dspm/lang/gltf/document.h"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "dspm/base/system/read_file.h"
#include "dspm/lang/gltf/excerpt.h"
#include "dspm/lang/gltf/meshopt.h"
#include "dspm/lang/gltf/uri.h"

namespace dspm::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

constexpr std::size_t kMostOfVersion = 20, kMostOfParser = 240;  // characters that a message quotes

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  if (at + 4 > bytes.size()) throw std::runtime_error("the file ends early");
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

}  // namespace

Document::Document(const std::filesystem::path& path) : Document(path, read_file(path)) {}

Document::Document(const std::filesystem::path& path, std::string file) : path_(path) {
  read_container(std::move(file));
  if (!json_.is_object()) throw std::runtime_error("it is not a glTF file: its JSON is not an object");
  check_version();
  read_buffers();
  expanded_.resize(root()["bufferViews"].size());
}

/// Checks the version. A file of a later glTF 2 that needs nothing of it can be read.
void Document::check_version() const {
  const Value asset = root()["asset"];
  if (!asset["version"].exists()) throw std::runtime_error("it is not a glTF file: asset/version is missing");
  const auto major = [](const std::string& version) { return version.substr(0, version.find('.')); };
  const std::string version = asset["version"].text(""), least = asset["minVersion"].text("2.0");
  if (major(version) != "2")
    throw std::runtime_error(fmt::format("it is of glTF {}, and dspm reads glTF 2", excerpt(version, kMostOfVersion)));
  if (least != "2.0")
    throw std::runtime_error(fmt::format("it needs glTF {}, and dspm reads glTF 2.0", excerpt(least, kMostOfVersion)));
}

void Document::read_container(std::string file) {
  bytes_ = file.size();
  std::string_view text = file;
  if (file.size() >= 12 && word_at(file, 0) == kMagic) {
    if (word_at(file, 4) != 2)
      throw std::runtime_error(fmt::format("it is of glTF {}, and dspm reads glTF 2", word_at(file, 4)));
    text = {};
    for (std::size_t at = 12; at + 8 <= file.size();) {
      const std::size_t size = word_at(file, at), kind = word_at(file, at + 4);
      if (size > file.size() - at - 8) throw std::runtime_error("the file ends early");
      const std::string_view chunk = std::string_view(file).substr(at + 8, size);
      if (kind == kJsonChunk && text.empty()) text = chunk;
      if (kind == kBinaryChunk && binary_.empty()) binary_ = chunk;
      at += 8 + size;
    }
  }
  try {
    json_ = Json::parse(text);
  } catch (const Json::exception& error) {
    throw std::runtime_error(fmt::format("it is not a glTF file: {}", excerpt(error.what(), kMostOfParser)));
  }
}

void Document::read_buffers() {
  const Value buffers = root()["buffers"];
  buffers_.resize(buffers.size());
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    const Value uri = buffers[i]["uri"];
    try {
      if (uri.exists())
        buffers_[i].bytes = resource(uri.text(""));
      else if (i == 0)
        buffers_[i].bytes = std::move(binary_);
    } catch (const std::runtime_error& error) {
      buffers_[i].missing = fmt::format("{}: {}", uri.place(), error.what());
    }
    bytes_ += buffers_[i].bytes.size();
  }
}

std::string Document::resource(const std::string& uri) const {
  if (auto data = data_of_uri(uri)) return *std::move(data);
  const std::filesystem::path name = unescaped(uri);
  try {
    return read_bytes(path_.parent_path() / name);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("\"{}\" cannot be read: {}", excerpt(name.string()), error.what()));
  }
}

std::string_view Document::slice(const Value& view) const {
  const Buffer& buffer = buffers_[view["buffer"].required_index(buffers_.size())];
  if (!buffer.missing.empty()) throw std::runtime_error(buffer.missing);
  const std::size_t offset = view["byteOffset"].count(0), length = view["byteLength"].count(0);
  if (offset > buffer.bytes.size() || length > buffer.bytes.size() - offset)
    view.fail(fmt::format("bytes {} to {} of a buffer of {}", offset, offset + length, buffer.bytes.size()));
  return std::string_view(buffer.bytes).substr(offset, length);
}

View Document::view(std::size_t index) const {
  const Value view = root()["bufferViews"][index];
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const Value compressed = view.extension(name);
    if (!compressed.exists()) continue;
    const std::lock_guard lock(mutex_);
    if (!expanded_[index])
      expanded_[index] = std::make_unique<std::string>(expand_meshopt(compressed, slice(compressed)));
    return {*expanded_[index], compressed["byteStride"].count(0)};
  }
  return {slice(view), view["byteStride"].count(0)};
}

std::string Document::picture(std::size_t index) const {
  const Value image = root()["images"][index];
  if (const auto at = image["bufferView"].index(root()["bufferViews"].size())) return std::string(view(*at).bytes);
  const Value uri = image["uri"];
  if (!uri.exists()) image.fail("it has neither uri nor bufferView");
  try {
    return resource(uri.text(""));
  } catch (const std::runtime_error& error) {
    uri.fail(error.what());
  }
}

std::string Document::extension_of_picture(std::size_t index) const {
  const Value image = root()["images"][index];
  const std::string uri = image["uri"].text("");
  const std::optional<std::string> inner = type_of_data_uri(uri);
  const std::string kind = image["mimeType"].text(inner.value_or(""));
  for (const char* type : {"image/png", "image/jpeg", "image/webp"})
    if (lower_case(kind) == type || inner == type)
      return type == std::string("image/jpeg") ? ".jpg" : "." + std::string(type + 6);
  const std::string own = inner ? "" : std::filesystem::path(unescaped(uri)).extension().string();
  return own.size() > 6 ? "" : own;
}

}  // namespace dspm::gltf
