// A shape's holes by a texture of numbers.
#pragma once

#include <optional>
#include <utility>

#include "dspm/shapes/cutout.h"
#include "dspm/shapes/shape.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/texture.h"

namespace dspm {

class TextureCutout final : public Cutout {
 public:
  explicit TextureCutout(TexturePtr<float> texture) : texture_(std::move(texture)) {}
  float alpha(const SurfacePoint& point) const override {
    return texture_->evaluate({point.p, point.uv, {}, {}, {}, {}, {}, point.vertices});
  }
  std::optional<PlainTexture<float>> plain() const override { return texture_->plain(); }

 private:
  TexturePtr<float> texture_;
};

}  // namespace dspm
