// Looks up a picture: which of its pixels count, and how much. For numbers and for colours.
#pragma once

#include <memory>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/mip_map.h"

namespace dspm {

/// The continuation of the picture outside of 0..1.
enum class Wrap { repeat, mirror, black, clamp, octahedral_sphere };

/// The part of a pixel that a lookup of a number takes. `usual` is the alpha of a picture that has one, else the mean
/// of red, green and blue; `alpha` is 1 if the picture has none.
enum class Channel { usual, red, green, blue, alpha };

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

 private:
  template <class T>
  T pixel(int level, int x, int y) const;
  template <class T>
  T nearest(int level, Vec2 st) const;
  template <class T>
  T bilinear(int level, Vec2 st) const;
  template <class T>
  T at_level(float level, Vec2 st) const;
  template <class T>
  T elliptical(Vec2 st, Vec2 longer, Vec2 shorter) const;
  template <class T>
  T elliptical(int level, Vec2 st, Vec2 longer, Vec2 shorter) const;

  /// The picture's longest side, in pixels of level 0.
  float longest_side() const;

  std::shared_ptr<const MipMap> picture_;
  Settings settings_;
};

}  // namespace dspm
