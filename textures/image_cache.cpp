#include "textures/image_cache.h"

namespace dspm {

std::shared_ptr<const Image> ImageCache::read(const std::filesystem::path& path, const ColorEncoding& encoding) {
  const Key key{std::filesystem::weakly_canonical(path).string(), encoding.kind, encoding.exponent};
  if (const auto found = images_.find(key); found != images_.end()) return found->second;
  return images_[key] = std::make_shared<const Image>(read_image(path, encoding));
}

}  // namespace dspm
