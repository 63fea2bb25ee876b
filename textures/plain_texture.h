// A texture as a plain value, which a device can have: one of a few kinds, some of them made of other plain textures, to
// which they point. It is looked up at points, where it has what the texture has for paths in RGB. The formulas of textures
// that stand here are those of their plugins, too.
#pragma once

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/textures/noise.h"
#include "dspm/textures/plain_image.h"
#include "dspm/textures/plain_mapping.h"

namespace dspm {

template <class T>
class PlainTexture;

/// What is made of the values of a picture.
struct PictureTone {
  float scale = 1;
  bool invert = false;

  constexpr float of(float pixel) const { return not_negative(invert ? 1 - pixel * scale : pixel * scale); }
  constexpr Rgb of(const Rgb& pixel) const { return {of(pixel.r), of(pixel.g), of(pixel.b)}; }

 private:
  static constexpr float not_negative(float v) { return std::max(v, 0.f); }
};

template <class T>
struct PlainImagemap {
  PlainImage image;
  PlainMapping mapping;
  PictureTone tone;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    image.each_array(fn);
  }

  constexpr T at(const PlainPlace& place) const {
    const Vec2 st = mapping.at(place);
    return tone.of(image.at<T>({st.x, 1 - st.y}));
  }
};

/// Returns 1 in cells with an even number along one axis, -1 in the others.
constexpr float sign_of_cell(float x) {
  const float cell = rounded::floor(x);  // a float, because it may exceed every integer type
  return cell == 2 * rounded::floor(cell / 2) ? 1.f : -1.f;
}

template <class T>
struct PlainCheckerboard {
  const PlainTexture<T>*first, *second;
  bool cubes;
  PlainMapping mapping;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(first, 1);
    fn(second, 1);
  }

  constexpr T at(const PlainPlace& place) const { return (sign(place) > 0 ? first : second)->at(place); }

 private:
  constexpr float sign(const PlainPlace& place) const {
    if (cubes) {
      const Vec3 own = mapping.own(place);
      return sign_of_cell(own.x) * sign_of_cell(own.y) * sign_of_cell(own.z);
    }
    const Vec2 st = mapping.at(place);
    return sign_of_cell(st.x) * sign_of_cell(st.y);
  }
};

/// Dots of one size in about half of the unit squares.
namespace dots {
inline constexpr float kRadius = 0.35f, kMostShift = 0.5f - kRadius;

/// Squares are centred on points with whole coordinates.
constexpr bool contain(Vec2 st) {
  const Vec2 square{rounded::floor(st.x + 0.5f), rounded::floor(st.y + 0.5f)};
  const auto random = [&](float x, float y) { return noise({square.x + x, square.y + y, 0.5f}); };
  if (!(random(0.5f, 0.5f) > 0)) return false;
  const Vec2 shift{kMostShift * random(1.5f, 2.8f), kMostShift * random(4.5f, 9.8f)};
  const Vec2 off = st - (square + shift);
  return off.x * off.x + off.y * off.y < kRadius * kRadius;
}
}  // namespace dots

template <class T>
struct PlainDots {
  const PlainTexture<T>*inside, *around;
  PlainMapping mapping;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(inside, 1);
    fn(around, 1);
  }

  constexpr T at(const PlainPlace& place) const {
    return (dots::contain(mapping.at(place)) ? inside : around)->at(place);
  }
};

/// Values at the corners of the unit square.
template <class T>
struct SquareCorners {
  T v00, v01, v10, v11;

  constexpr T at(Vec2 st) const {
    return (v00 * (1 - st.x) + v10 * st.x) * (1 - st.y) + (v01 * (1 - st.x) + v11 * st.x) * st.y;
  }
};

template <class T>
struct PlainBilerp {
  SquareCorners<T> corners;
  PlainMapping mapping;

  constexpr T at(const PlainPlace& place) const { return corners.at(mapping.at(place)); }
};

/// The textures fbm, wrinkled and windy.
struct PlainNoise {
  enum class Kind { fbm, wrinkled, windy };

  Kind kind;
  Octaves octaves;  // not of windy
  Transform world_from_texture;

  constexpr float at(const PlainPlace& place) const {
    const Vec3 own = world_from_texture.inverse_point(place.p);
    switch (kind) {
      case Kind::fbm: return fbm(own, octaves);
      case Kind::wrinkled: return turbulence(own, octaves);
      case Kind::windy: break;
    }
    constexpr Octaves kGusts{3, 0.5f}, kWaves{6, 0.5f};
    return std::abs(fbm(own * 0.1f, kGusts)) * fbm(own, kWaves);
  }
};

template <class T>
struct PlainScale {
  const PlainTexture<T>* texture;
  const PlainTexture<float>* scale;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(texture, 1);
    fn(scale, 1);
  }

  constexpr T at(const PlainPlace& place) const;
};

/// Returns the mix of two values; V is a number, a colour or a Spectrum.
template <class V>
constexpr V mixed(const V& first, const V& second, float amount) {
  return first * (1 - amount) + second * amount;
}

template <class T>
struct PlainMix {
  const PlainTexture<T>*first, *second;
  const PlainTexture<float>* amount;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(first, 1);
    fn(second, 1);
    fn(amount, 1);
  }

  constexpr T at(const PlainPlace& place) const;
};

template <class T>
class PlainTexture {
  enum class Kind : unsigned char { constant, imagemap, checkerboard, dots, bilerp, noise, scale, mix };

 public:
  /// The most textures, one within the other, that can be looked up where calls within calls have little room.
  static constexpr int kMaxDepth = 6;

  constexpr PlainTexture(const T& value) : kind_(Kind::constant), constant_(value) {}
  constexpr PlainTexture(const PlainImagemap<T>& image) : kind_(Kind::imagemap), imagemap_(image) {}
  constexpr PlainTexture(const PlainBilerp<T>& bilerp) : kind_(Kind::bilerp), bilerp_(bilerp) {}
  constexpr PlainTexture(const PlainNoise& noise) : kind_(Kind::noise), noise_(noise) {}
  // These point to textures that must outlive them.
  constexpr PlainTexture(const PlainCheckerboard<T>& board)
      : kind_(Kind::checkerboard), depth_(above(board.first, board.second)), checkerboard_(board) {}
  constexpr PlainTexture(const PlainDots<T>& dots)
      : kind_(Kind::dots), depth_(above(dots.inside, dots.around)), dots_(dots) {}
  constexpr PlainTexture(const PlainScale<T>& scale)
      : kind_(Kind::scale), depth_(above(scale.texture, scale.scale)), scale_(scale) {}
  constexpr PlainTexture(const PlainMix<T>& mix)
      : kind_(Kind::mix), depth_(above(mix.first, mix.second, mix.amount)), mix_(mix) {}

  /// Never inlined: materials look several textures up, and devices would have the code of all kinds for each.
  [[gnu::noinline]] constexpr T at(const PlainPlace& place) const {
    switch (kind_) {
      case Kind::constant: return constant_;
      case Kind::imagemap: return imagemap_.at(place);
      case Kind::checkerboard: return checkerboard_.at(place);
      case Kind::dots: return dots_.at(place);
      case Kind::bilerp: return bilerp_.at(place);
      case Kind::noise: return T(noise_.at(place));
      case Kind::scale: return scale_.at(place);
      case Kind::mix: break;
    }
    return mix_.at(place);
  }

  /// The number of textures, one within the other, up to this one; above kMaxDepth also if a part is null. It may then
  /// not be looked up.
  constexpr int depth() const { return depth_; }

  /// Calls fn(Plain...&) with what it is.
  template <class Fn>
  constexpr void of_kind(Fn&& fn) {
    switch (kind_) {
      case Kind::constant: return fn(constant_);
      case Kind::imagemap: return fn(imagemap_);
      case Kind::checkerboard: return fn(checkerboard_);
      case Kind::dots: return fn(dots_);
      case Kind::bilerp: return fn(bilerp_);
      case Kind::noise: return fn(noise_);
      case Kind::scale: return fn(scale_);
      case Kind::mix: break;
    }
    fn(mix_);
  }
  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    of_kind([&](auto& kind) {
      if constexpr (requires { kind.each_array(fn); }) kind.each_array(fn);
    });
  }

 private:
  template <class... Parts>
  static constexpr int above(const Parts*... parts) {
    int most = 0;
    ((most = std::max(most, parts == nullptr ? 1000 : parts->depth())), ...);
    return 1 + most;
  }

  Kind kind_;
  int depth_ = 1;
  union {
    T constant_;
    PlainImagemap<T> imagemap_;
    PlainCheckerboard<T> checkerboard_;
    PlainDots<T> dots_;
    PlainBilerp<T> bilerp_;
    PlainNoise noise_;
    PlainScale<T> scale_;
    PlainMix<T> mix_;
  };
};

template <class T>
constexpr T PlainScale<T>::at(const PlainPlace& place) const {
  return texture->at(place) * scale->at(place);
}

template <class T>
constexpr T PlainMix<T>::at(const PlainPlace& place) const {
  return mixed(first->at(place), second->at(place), amount->at(place));
}

}  // namespace dspm
