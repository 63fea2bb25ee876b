#include "textures/image_cache.h"

namespace dspm {

std::shared_ptr<const Image> ImageCache::read(const std::filesystem::path& path, const ColorEncoding& encoding) {
  const Key key{std::filesystem::weakly_canonical(path).string(), encoding.kind, encoding.exponent};
  std::weak_ptr<const Image>& known = images_[key];
  std::shared_ptr<const Image> image = known.lock();
  if (!image) known = image = std::make_shared<const Image>(read_image(path, encoding));
  return image;
}

}  // namespace dspm
