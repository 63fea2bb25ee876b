// A colour of what a surface reflects or lets through as a plain value, which a device can have: the same everywhere, or a
// texture.
#pragma once

#include <algorithm>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/textures/plain_mapping.h"
#include "dspm/textures/plain_texture.h"

namespace dspm {

struct PlainAlbedo {
  Spectrum everywhere;                         // where there is no texture
  const PlainTexture<Rgb>* texture = nullptr;  // of paths in RGB; must outlive this

  constexpr Spectrum at(const PlainPlace& place) const {
    if (texture == nullptr) return everywhere;
    const Rgb value = texture->at(place);
    return clamped_albedo(Spectrum(value.r, value.g, value.b));
  }
};

}  // namespace dspm
