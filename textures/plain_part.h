// What textures and materials keep of the plain forms of textures that they are made of.
#pragma once

#include <optional>

#include "dspm/textures/plain_texture.h"
#include "dspm/textures/texture.h"

namespace dspm {

/// The plain form of a texture, at one place for good.
template <class T>
class PlainPart {
 public:
  explicit PlainPart(const Texture<T>& texture) : plain_(texture.plain()) {}

  /// Returns null if the texture has none.
  const PlainTexture<T>* get() const { return plain_ ? &*plain_ : nullptr; }

 private:
  std::optional<PlainTexture<T>> plain_;
};

/// Returns the texture unless a part of it is null, or it is too deep for devices.
template <class T>
std::optional<PlainTexture<T>> if_sound(const PlainTexture<T>& texture) {
  return texture.depth() <= PlainTexture<T>::kMaxDepth ? std::optional(texture) : std::nullopt;
}

}  // namespace dspm
