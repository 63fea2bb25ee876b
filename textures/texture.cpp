#include "dspm/textures/texture.h"

#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/textures/plain_texture.h"

namespace dspm {

template <class T>
std::optional<PlainTexture<T>> Texture<T>::plain() const {
  if (!is_uniform()) return std::nullopt;
  const Carried<T> value = carried(TexturePoint{});
  if constexpr (std::is_same_v<T, float>)
    return PlainTexture<float>(value);
  else
    return PlainTexture<Rgb>(Rgb(value[0], value[1], value[2]));
}

template std::optional<PlainTexture<float>> Texture<float>::plain() const;
template std::optional<PlainTexture<Rgb>> Texture<Rgb>::plain() const;

}  // namespace dspm
