// What textures and materials keep of the plain forms of textures that they are made of.
#pragma once

#include <optional>
#include <utility>

#include "dspm/base/colour/palette.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plain_value.h"
#include "dspm/textures/texture.h"

namespace dspm {

/// The plain form of a texture, at one place for good.
template <class T>
class PlainPart {
 public:
  explicit PlainPart(TexturePtr<T> texture) : texture_(std::move(texture)), plain_(texture_->plain()) {}

  /// Returns null if the texture has none.
  const PlainTexture<T>* get() const { return plain_ ? &*plain_ : nullptr; }

  /// Returns what paths of that palette carry of it at points; nullopt if that is not known. This must outlive it.
  std::optional<PlainValue<T>> value(const Palette& palette) const {
    TexturePoint anywhere;
    anywhere.palette = &palette;
    if (texture_->is_uniform()) return PlainValue<T>{texture_->carried(anywhere)};
    return palette.is_rgb() && plain_ ? std::optional(PlainValue<T>{{}, &*plain_}) : std::nullopt;
  }

 private:
  TexturePtr<T> texture_;
  std::optional<PlainTexture<T>> plain_;
};

/// Returns the texture unless a part of it is null, or it is too deep for devices.
template <class T>
std::optional<PlainTexture<T>> if_sound(const PlainTexture<T>& texture) {
  return texture.depth() <= PlainTexture<T>::kMaxDepth ? std::optional(texture) : std::nullopt;
}

}  // namespace dspm
