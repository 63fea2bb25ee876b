// A texture: a value that varies over a surface. Materials hold textures; a plain number in the scene becomes a texture
// that is the same everywhere.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "dspm/base/colour/colour.h"
#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/math/vertex_data.h"

namespace dspm {

/// The place where a texture is looked up, all in the world. A lookup may average over a footprint, the ellipse around
/// p whose axes are dpdx and dpdy, as in pbrt; they are zero for a point. Only textures that say so get a footprint
/// (Texture::averages).
struct TexturePoint {
  Vec3 p;
  Vec2 uv;
  Vec3 n{};             // geometric normal, unit length
  Vec3 dpdu{}, dpdv{};  // derivatives of p by uv; dpdv is zero if they are not known
  Vec3 dpdx{}, dpdy{};  // the footprint
  VertexPlace vertices{};
  const Palette* palette = &Palette::rgb();  // of the path that has come here
};

/// What a path carries of a texture's values.
template <class T>
struct CarriedAs;
template <>
struct CarriedAs<float> {
  using Type = float;
};
template <>
struct CarriedAs<Rgb> {
  using Type = Spectrum;
};
template <class T>
using Carried = typename CarriedAs<T>::Type;
inline float carried(float value, const TexturePoint&) { return value; }
inline Spectrum carried(const Rgb& value, const TexturePoint& at) { return at.palette->carried(value); }

/// Returns whether a surface can reflect the colour.
inline bool is_albedo(const Rgb& c) { return c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1; }

template <class T>
class PlainTexture;

template <class T>
class Texture {
 public:
  virtual ~Texture() = default;
  virtual T evaluate(const TexturePoint& at) const = 0;
  /// The value for paths. Textures of spectra, and of other textures, know more of it than the colour says.
  virtual Carried<T> carried(const TexturePoint& at) const { return dspm::carried(evaluate(at), at); }
  /// Returns the value if it is the same everywhere. Call it once, when a material is made.
  virtual std::optional<T> constant() const { return std::nullopt; }
  /// Returns whether carried() is the same everywhere, to the bit. What has a constant() may be made of several spectra of
  /// one colour, or be rounded in one way here and in another there.
  virtual bool is_uniform() const { return false; }
  /// Returns whether evaluate() over a footprint is the mean of its values at points, and these lie in 0..1, so that
  /// nothing cuts them off before they are averaged. Other textures are looked up at points only. Call it once, too.
  virtual bool averages() const { return false; }
  /// Returns the texture as a plain value, which a device can have (plain_texture.h). At points without a footprint it has
  /// what carried() has for paths in RGB, to the bit. By default there is none, unless the texture is uniform. It may point
  /// to what the texture keeps, which must outlive it.
  virtual std::optional<PlainTexture<T>> plain() const;
};

/// These look a texture up, as evaluate() and as carried(): textures of textures do both alike.
struct Evaluate {
  const TexturePoint& at;
  template <class T>
  T operator()(const std::shared_ptr<const Texture<T>>& texture) const {
    return texture->evaluate(at);
  }
};
struct Carry {
  const TexturePoint& at;
  template <class T>
  Carried<T> operator()(const std::shared_ptr<const Texture<T>>& texture) const {
    return texture->carried(at);
  }
};

using FloatTexture = Texture<float>;
using RgbTexture = Texture<Rgb>;

/// Textures are shared: by materials, by other textures and between frames.
template <class T>
using TexturePtr = std::shared_ptr<const Texture<T>>;

template <class T>
class ConstantTexture final : public Texture<T> {
 public:
  explicit ConstantTexture(const T& value) : value_(value) {}
  T evaluate(const TexturePoint&) const override { return value_; }
  Carried<T> carried(const TexturePoint& at) const override { return dspm::carried(value_, at); }
  std::optional<T> constant() const override { return value_; }
  bool is_uniform() const override { return true; }
  bool averages() const override { return is_albedo(Rgb(value_)); }

 private:
  T value_;
};

/// A colour everywhere that is given as a spectrum.
class SpectrumTexture final : public Texture<Rgb> {
 public:
  explicit SpectrumTexture(Colour colour) : colour_(std::move(colour)) {}
  Rgb evaluate(const TexturePoint&) const override { return colour_.rgb; }
  Spectrum carried(const TexturePoint& at) const override { return at.palette->carried(colour_); }
  std::optional<Rgb> constant() const override { return colour_.rgb; }
  bool is_uniform() const override { return true; }
  bool averages() const override { return is_albedo(colour_.rgb); }

 private:
  Colour colour_;
};

}  // namespace dspm
