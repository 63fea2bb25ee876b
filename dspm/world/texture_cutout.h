// A shape's holes by a texture of numbers.
#pragma once

#include <utility>

#include "dspm/math/vec.h"
#include "dspm/shapes/cutout.h"
#include "dspm/textures/texture.h"

namespace dspm {

class TextureCutout final : public Cutout {
 public:
  explicit TextureCutout(TexturePtr<float> texture) : texture_(std::move(texture)) {}
  float alpha(const Vec3& p, Vec2 uv) const override { return texture_->evaluate({p, uv}); }

 private:
  TexturePtr<float> texture_;
};

}  // namespace dspm
