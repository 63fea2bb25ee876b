// The textures fbm, wrinkled and windy, which have but a formula at points.
#pragma once

#include <optional>

#include "dspm/textures/plain_texture.h"
#include "dspm/textures/texture.h"

namespace dspm {

template <class T>
class NoiseTexture final : public Texture<T> {
 public:
  explicit NoiseTexture(const PlainNoise& noise) : noise_(noise) {}

  T evaluate(const TexturePoint& at) const override { return T(noise_.at({at.p, at.uv})); }
  std::optional<PlainTexture<T>> plain() const override { return PlainTexture<T>(noise_); }

 private:
  PlainNoise noise_;
};

}  // namespace dspm
