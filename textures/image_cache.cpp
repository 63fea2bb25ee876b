#include "dspm/textures/image_cache.h"

#include <algorithm>

#include "dspm/image/read_picture.h"

namespace dspm {

std::shared_ptr<const MipMap> ImageCache::read(const std::filesystem::path& path, const ColorEncoding& encoding) {
  const Key key{std::filesystem::weakly_canonical(path).string(), encoding.kind, encoding.exponent};
  std::weak_ptr<const MipMap>& known = images_[key];
  std::shared_ptr<const MipMap> image = known.lock();
  if (!image) known = image = std::make_shared<const MipMap>(read_picture(path, encoding), filtered_);
  return image;
}

int ImageCache::alive() const {
  return static_cast<int>(
      std::count_if(images_.begin(), images_.end(), [](const auto& entry) { return !entry.second.expired(); }));
}

}  // namespace dspm
