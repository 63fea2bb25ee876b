#include "dspm/textures/mip_map.h"

#include "dspm/image/shrink.h"

namespace dspm {

MipMap::MipMap(Image image, bool smaller) {
  levels_.push_back(std::move(image));
  while (smaller && (levels_.back().width > 1 || levels_.back().height > 1)) {
    const Image& last = levels_.back();
    levels_.push_back(shrunk(last, (last.width + 1) / 2, (last.height + 1) / 2));
  }
}

}  // namespace dspm
