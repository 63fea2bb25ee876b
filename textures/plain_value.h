// A parameter of a material as a plain value, which a device can have: the same everywhere, or a texture.
#pragma once

#include <type_traits>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/textures/plain_mapping.h"
#include "dspm/textures/plain_texture.h"

namespace dspm {

template <class T>
struct PlainValue {
  /// What paths carry of it.
  using Carried = std::conditional_t<std::is_same_v<T, Rgb>, Spectrum, T>;

  Carried everywhere{};                      // if there is no texture
  const PlainTexture<T>* texture = nullptr;  // for paths in RGB; must outlive this

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(texture, 1);
  }

  constexpr bool varies() const { return texture != nullptr; }
  constexpr Carried at(const PlainPlace& place) const {
    if (texture == nullptr) return everywhere;
    const T value = texture->at(place);
    if constexpr (std::is_same_v<T, Rgb>)
      return Spectrum(value.r, value.g, value.b);
    else
      return value;
  }
};

}  // namespace dspm
