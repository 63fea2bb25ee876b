// Pictures shared by several textures, or by one texture in several frames: each file is read once per encoding, as
// long as a texture holds it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "dspm/image/image.h"
#include "dspm/textures/mip_map.h"

namespace dspm {

class ImageCache {
 public:
  /// `filtered` says whether lookups have footprints, for which smaller pictures are made. They take a third more
  /// memory.
  explicit ImageCache(bool filtered = true) : filtered_(filtered) {}

  /// Throws std::runtime_error as read_image does.
  std::shared_ptr<const MipMap> read(const std::filesystem::path& path, const ColorEncoding& encoding);
  /// The number of images that textures hold.
  int alive() const;

 private:
  using Key = std::tuple<std::string, ColorEncoding::Kind, float>;
  bool filtered_;
  std::map<Key, std::weak_ptr<const MipMap>> images_;
};

}  // namespace dspm
