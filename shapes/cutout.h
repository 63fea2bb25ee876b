// A cutout says where a shape has holes: pbrt's "alpha". Shapes know no textures, so world implements this with one. The
// ray decides whether a hole that lets some rays through is one for it: a formula that a GPU shares with the CPU.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"

namespace dspm {

struct SurfacePoint;
template <class T>
class PlainTexture;

class Cutout {
 public:
  virtual ~Cutout() = default;
  /// The fraction of rays that the surface stops at a point of the world: all of them from 1 on, none up to 0.
  virtual float alpha(const SurfacePoint& point) const = 0;
  /// Returns it as a plain texture (textures/plain_texture.h), which a device can have; nullopt if there is none. This must
  /// outlive it.
  virtual std::optional<PlainTexture<float>> plain() const = 0;
};

/// Returns a number in [0, 1) that is a function of a ray's bits and of the point at which it meets a shape.
constexpr float number_in_hole(const Ray& ray, std::uint64_t shape, int primitive, Vec2 uv) {
  std::uint64_t key = mix_bits(shape + 1);
  const auto absorb = [&](std::uint32_t a, std::uint32_t b) {
    key = mix_bits(key + 0x9e3779b97f4a7c15u * ((std::uint64_t{a} << 32 | b) + 1));
  };
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  absorb(static_cast<std::uint32_t>(primitive), bits(ray.direction.z));
  absorb(bits(ray.origin.x), bits(ray.origin.y));
  absorb(bits(ray.origin.z), bits(ray.direction.x));
  absorb(bits(ray.direction.y), bits(uv.x));
  absorb(bits(uv.y), 0);
  return static_cast<float>(key >> 40) * 0x1p-24f;
}

/// Returns whether a shape that has this alpha there stops a ray, in the world, that meets it there; see
/// PlacedShape::stops().
constexpr bool stops(float alpha, const Ray& ray, std::uint64_t cutout_key, int primitive, Vec2 uv) {
  return alpha >= 1 || (alpha > 0 && number_in_hole(ray, cutout_key, primitive, uv) < alpha);
}

inline constexpr const char* kAlphaParam = "alpha";

/// Reads "alpha" of any shape, for any plugin. Call it before the shape's own factory reads the rest.
inline ValueOrTexture<float> read_alpha(ParamReader& params) {
  return params.number_or_texture(kAlphaParam, 1, "", "the fraction of rays that the surface stops; 0: a hole");
}

}  // namespace dspm
