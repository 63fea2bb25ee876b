// Looks up a picture: which of its pixels count, and how much. For numbers and for colours.
#pragma once

#include <memory>
#include <optional>

#include "dspm/base/math/vec.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/mip_map.h"
#include "dspm/textures/plain_image.h"

namespace dspm {

enum class ImageFilter { point, bilinear, trilinear, ewa };

class ImageLookup {
 public:
  struct Settings {
    ImageFilter filter = ImageFilter::bilinear;
    Wrap wrap = Wrap::repeat;         // along s
    std::optional<Wrap> wrap_v = {};  // along t; none: as along s
    Channel channel = Channel::usual;
    float max_anisotropy = 8;  // of ewa: how much longer than wide an ellipse may be
  };

  ImageLookup(std::shared_ptr<const MipMap> picture, const Settings& settings)
      : picture_(std::move(picture)), settings_(settings) {}

  /// Returns the value at a place; (0, 0) is the picture's upper left corner.
  template <class T>
  T at(const TextureCoordinates& coordinates) const;

  /// Returns the picture as lookups at points take it, which is valid for as long as this has it.
  PlainImage plain() const { return picture(0); }

 private:
  template <class T>
  T at_level(float level, Vec2 st) const;
  template <class T>
  T elliptical(Vec2 st, Vec2 longer, Vec2 shorter) const;
  template <class T>
  T elliptical(int level, Vec2 st, Vec2 longer, Vec2 shorter) const;

  PlainImage picture(int level) const;
  /// The picture's longest side, in pixels of level 0.
  float longest_side() const;

  std::shared_ptr<const MipMap> picture_;
  Settings settings_;
};

}  // namespace dspm
