#include "dspm/output/whole_mp4.h"

#include <cstdint>
#include <fstream>
#include <set>
#include <string>

namespace dspm {
namespace {

/// Reads a number of that many bytes, the most significant first.
std::uint64_t number(std::istream& file, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | static_cast<std::uint8_t>(file.get());
  return value;
}

}  // namespace

bool is_whole_mp4(const std::filesystem::path& path) {
  constexpr std::uint64_t kHeader = 8, kLongHeader = 16, kSizeFollows = 1;
  std::error_code none;
  const std::uint64_t length = std::filesystem::file_size(path, none);
  std::ifstream file(path, std::ios::binary);  // if there is none, its first box cannot be read
  std::set<std::string> boxes;
  for (std::uint64_t at = 0; at < length;) {
    file.seekg(static_cast<std::streamoff>(at));
    std::uint64_t size = number(file, 4), least = kHeader;
    std::string type(4, '\0');
    file.read(type.data(), 4);
    if (size == kSizeFollows) size = number(file, 8), least = kLongHeader;
    if (!file || size < least || size > length - at) return false;
    boxes.insert(type);
    at += size;
  }
  return boxes.contains("ftyp") && boxes.contains("moov") && boxes.contains("mdat");
}

}  // namespace dspm
