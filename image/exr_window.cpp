#include "dspm/image/exr_window.h"

#include <utility>

#include "dspm/image/decoders.h"
#include "dspm/image/exr_file.h"

namespace dspm {

Image in_display_window(Image pixels, std::string_view exr) {
  const OpenExr file(exr);
  const Imath::Box2i &display = file.header().displayWindow(), &data = file.header().dataWindow();
  if (display == data || display.isEmpty() || !display.intersects(data)) return pixels;
  const auto size = [](int low, int high) { return std::int64_t{high} - low + 1; };
  Image whole = sized_image(size(display.min.x, display.max.x), size(display.min.y, display.max.y), exr.size());
  if (!pixels.alpha.empty()) whole.alpha.resize(whole.pixels.size());
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      const int to_x = data.min.x - display.min.x + x, to_y = data.min.y - display.min.y + y;
      if (to_x < 0 || to_y < 0 || to_x >= whole.width || to_y >= whole.height) continue;
      whole.at(to_x, to_y) = pixels.at(x, y);
      if (!pixels.alpha.empty()) whole.alpha[whole.index(to_x, to_y)] = pixels.alpha[pixels.index(x, y)];
    }
  return whole;
}

}  // namespace dspm
