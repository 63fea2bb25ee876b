#include "dspm/integrators/methods/vcm/splats.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/system/parallel.h"
#include "dspm/integrators/tiles.h"

namespace dspm {
namespace {

constexpr int kBands = 16;  // of rows, one unit of parallel work each

/// Pixels from begin to end - 1 along one axis.
struct PixelRange {
  int begin, end;
};

/// Returns the pixels within [low, high) whose centres are no further than `radius` from the place.
PixelRange pixels_near(float place, float radius, int low, int high) {
  const float first = std::ceil(place - radius - 0.5f), last = std::floor(place + radius - 0.5f);
  const auto bounded = [&](float pixel) {
    return static_cast<int>(std::clamp(pixel, static_cast<float>(low), static_cast<float>(high)));
  };
  return {bounded(first), bounded(last + 1)};
}

void add(const Splat& splat, const RenderSettings& render, int y0, int y1, SeenLightSums& sums) {
  const PixelFilter& filter = *render.filter;
  const PixelRange rows = pixels_near(splat.film.y, filter.radius().y, y0, y1);
  if (rows.begin >= rows.end) return;
  const PixelRange columns = pixels_near(splat.film.x, filter.radius().x, render.crop.x0, render.crop.x1);
  for (int y = rows.begin; y < rows.end; ++y)
    for (int x = columns.begin; x < columns.end; ++x) {
      const Vec2 centre{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
      const float density = filter.density(splat.film - centre);
      if (density > 0)
        sums.add({splat.frames, splat.radiance * density, pixel_in_crop(render.crop, x, y), splat.light, splat.caught,
                  splat.of_media});
    }
}

}  // namespace

bool is_seen(Vec2 film, const RenderSettings& render) {
  const PixelRange columns = pixels_near(film.x, render.filter->radius().x, render.crop.x0, render.crop.x1);
  const PixelRange rows = pixels_near(film.y, render.filter->radius().y, render.crop.y0, render.crop.y1);
  return columns.begin < columns.end && rows.begin < rows.end;
}

void add_splats(std::span<const std::span<const Splat>> splats, const RenderSettings& render, SeenLightSums& sums) {
  const int rows = (render.crop.height() + kBands - 1) / kBands;
  parallel_for(kBands, 1, [&](std::int64_t band) {
    const int y0 = render.crop.y0 + static_cast<int>(band) * rows, y1 = std::min(y0 + rows, render.crop.y1);
    if (y0 >= y1) return;
    for (const std::span<const Splat>& some : splats)
      for (const Splat& splat : some) add(splat, render, y0, y1, sums);
  });
}

}  // namespace dspm
