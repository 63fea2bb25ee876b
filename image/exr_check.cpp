#include "dspm/image/exr_check.h"

#include <ImfHeader.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

namespace dspm {

namespace {

/// Returns the size of an attribute of that type in bytes, if it is always the same. [OpenEXR File Layout, openexr.com]
std::optional<std::size_t> bytes_of(std::string_view type) {
  static constexpr std::pair<std::string_view, std::size_t> table[] = {{"box2f", 16},
                                                                       {"box2i", 16},
                                                                       {"chromaticities", 32},
                                                                       {"compression", 1},
                                                                       {"deepImageState", 1},
                                                                       {"double", 8},
                                                                       {"envmap", 1},
                                                                       {"float", 4},
                                                                       {"int", 4},
                                                                       {"keycode", 28},
                                                                       {"m33d", 72},
                                                                       {"m33f", 36},
                                                                       {"m44d", 128},
                                                                       {"m44f", 64},
                                                                       {"lineOrder", 1},
                                                                       {"rational", 8},
                                                                       {"tiledesc", 9},
                                                                       {"timecode", 8},
                                                                       {"v2d", 16},
                                                                       {"v2f", 8},
                                                                       {"v2i", 8},
                                                                       {"v3d", 24},
                                                                       {"v3f", 12},
                                                                       {"v3i", 12}};
  for (const auto& [name, bytes] : table)
    if (name == type) return bytes;
  return std::nullopt;
}

/// Returns whether the value is a list of channels, which ends with an empty name at its very end. Each name is
/// followed by 16 bytes.
bool is_channel_list(std::string_view value) {
  while (true) {
    const std::size_t name = value.find('\0');
    if (name == std::string_view::npos) return false;
    if (name == 0) return value.size() == 1;
    if (value.size() < name + 17) return false;
    value.remove_prefix(name + 17);
  }
}

bool is_whole(std::string_view type, std::string_view value) {
  return type == "chlist" ? is_channel_list(value) : value.size() == bytes_of(type).value_or(value.size());
}

/// The library allocates what a header's attributes claim before it finds the file to be shorter, and for most types it
/// relies on what it has read, not on the size that the file states. So they are checked here first, and both must
/// agree. An attribute is a name and a type, both ended by a zero byte, a size, and that many bytes; an empty name ends
/// the attributes of an EXR part.
void check_attributes(std::string_view bytes) {
  const auto damaged = [] { return std::runtime_error("its header is damaged"); };
  if (bytes.size() < 8) throw damaged();
  const bool several_parts = (bytes[5] & 0x10) != 0;
  bytes.remove_prefix(8);
  while (true) {
    const std::size_t name = bytes.find('\0'), type = bytes.find('\0', name == 0 ? 0 : name + 1);
    if (name == std::string_view::npos || type == std::string_view::npos) throw damaged();
    if (name == 0) {
      bytes.remove_prefix(1);
      if (!several_parts || bytes.starts_with('\0')) return;
      continue;
    }
    std::uint32_t size = 0;
    const std::string_view type_name = bytes.substr(name + 1, type - name - 1);
    bytes.remove_prefix(type + 1);
    if (bytes.size() < sizeof size) throw damaged();
    std::memcpy(&size, bytes.data(), sizeof size);  // little endian, as we are
    if (size > bytes.size() - sizeof size || !is_whole(type_name, bytes.substr(sizeof size, size))) throw damaged();
    bytes.remove_prefix(sizeof size + size);
  }
}

/// Makes the library refuse absurd sizes: it also allocates tables by the image's size before we see it.
void bound_sizes() {
  constexpr int kMaxSide = 1 << 17, kMaxTile = 1 << 12;
  Imf::Header::setMaxImageSize(kMaxSide, kMaxSide);
  Imf::Header::setMaxTileSize(kMaxTile, kMaxTile);
}

}  // namespace

void check_exr(std::string_view bytes) {
  bound_sizes();
  check_attributes(bytes);
}

}  // namespace dspm
