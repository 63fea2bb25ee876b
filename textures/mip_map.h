// A picture at ever smaller sizes, for lookups that average over much of it. [Williams 1983, Pyramidal Parametrics]
#pragma once

#include <vector>

#include "dspm/image/image.h"

namespace dspm {

class MipMap {
 public:
  /// Makes level 0 alone if `smaller` is false.
  explicit MipMap(Image image, bool smaller = true);

  /// The number of levels. Level 0 is the picture itself; each of the others is half as large, rounded up, down to a
  /// single pixel. A pixel is the mean of those that it covers.
  int levels() const { return static_cast<int>(levels_.size()); }
  const Image& level(int i) const { return levels_[static_cast<std::size_t>(i)]; }

 private:
  std::vector<Image> levels_;
};

}  // namespace dspm
