// A shape's holes by a texture of numbers.
#pragma once

#include <utility>

#include "dspm/shapes/cutout.h"
#include "dspm/shapes/shape.h"
#include "dspm/textures/texture.h"

namespace dspm {

class TextureCutout final : public Cutout {
 public:
  explicit TextureCutout(TexturePtr<float> texture) : texture_(std::move(texture)) {}
  float alpha(const SurfacePoint& point) const override {
    return texture_->evaluate({point.p, point.uv, {}, {}, {}, {}, {}, point.vertices});
  }

 private:
  TexturePtr<float> texture_;
};

}  // namespace dspm
