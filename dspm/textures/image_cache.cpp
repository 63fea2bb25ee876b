#include "dspm/textures/image_cache.h"

#include <algorithm>

namespace dspm {

std::shared_ptr<const Image> ImageCache::read(const std::filesystem::path& path, const ColorEncoding& encoding) {
  const Key key{std::filesystem::weakly_canonical(path).string(), encoding.kind, encoding.exponent};
  std::weak_ptr<const Image>& known = images_[key];
  std::shared_ptr<const Image> image = known.lock();
  if (!image) known = image = std::make_shared<const Image>(read_image(path, encoding));
  return image;
}

int ImageCache::alive() const {
  return static_cast<int>(
      std::count_if(images_.begin(), images_.end(), [](const auto& entry) { return !entry.second.expired(); }));
}

}  // namespace dspm
