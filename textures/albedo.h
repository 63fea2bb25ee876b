// What a material has of a texture of albedos: it is looked up, and its plain form kept.
#pragma once

#include <optional>
#include <utility>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/textures/plain_albedo.h"
#include "dspm/textures/plain_part.h"
#include "dspm/textures/texture.h"

namespace dspm {

class Albedo {
 public:
  explicit Albedo(TexturePtr<Rgb> texture) : texture_(std::move(texture)), plain_(*texture_) {}

  bool averages() const { return texture_->averages(); }
  Spectrum at(const TexturePoint& place) const { return clamped_albedo(texture_->carried(place)); }

  /// Returns what it has at points, for paths of that palette. This must outlive it.
  std::optional<PlainAlbedo> plain(const Palette& palette) const {
    TexturePoint anywhere;
    anywhere.palette = &palette;
    if (texture_->is_uniform()) return PlainAlbedo{at(anywhere)};
    if (!palette.is_rgb() || plain_.get() == nullptr) return std::nullopt;
    return PlainAlbedo{Spectrum(0), plain_.get()};
  }

 private:
  TexturePtr<Rgb> texture_;
  PlainPart<Rgb> plain_;
};

}  // namespace dspm
