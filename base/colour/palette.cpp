#include "dspm/base/colour/palette.h"

#include "dspm/base/colour/interference.h"

namespace dspm {

constinit const Palette Palette::kRgb;

Rgb Palette::seen(int component) const {
  Spectrum one;
  one[component] = 1;
  return seen(one);
}

Spectrum Palette::interference(float path_nm) const {
  const Rgb colour = dspm::interference(path_nm);
  return {colour.r, colour.g, colour.b};
}

}  // namespace dspm
