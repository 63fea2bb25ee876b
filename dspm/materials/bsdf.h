// Scattering at one point of a surface: what a material becomes once its textures are looked up there. All directions
// are in world space, of unit length, and point away from the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

#include "dspm/colour/rgb.h"
#include "dspm/math/vec.h"

namespace dspm {

/// What a path carries. Refraction scales radiance by (eta_i/eta_t)^2 and leaves flux alone. [Veach 1997, 5.2]
enum class Transport { radiance, flux };

/// A subset of a Bsdf's lobes, one bit each.
using LobeSet = std::uint8_t;

struct BsdfSample {
  Vec3 wi;
  Rgb weight;     // f |cos(wi, ns)| / pdf_w; for a specular lobe: its share of the light over the chance of its choice
  float pdf_w;    // by solid angle, over the lobes asked for; 0 where specular
  bool specular;  // the direction was the only possible one: pdf_w and evaluate know nothing of it
  // What refraction did to radiance, (eta_i/eta_t)^2, and will undo on the way out: roulette leaves it out of account.
  float eta_scale = 1;
};

/// Plain values without owned memory: a Bsdf may be copied byte by byte (see BsdfSlot).
class Bsdf {
 public:
  /// The lobes whose roughness is at least `least_alpha`: GGX alpha, 0 for specular, diffuse always belongs to them.
  virtual LobeSet lobes(float least_alpha) const = 0;
  LobeSet all_lobes() const { return lobes(0); }
  /// f(wo, wi) in 1/sr, without the cosine, summed over `lobes`; specular lobes add nothing. Reflection and
  /// transmission are told apart by the geometric normal; where it and ns disagree about the side that light comes from
  /// (wi for radiance, wo for flux) there is none. So f for flux is f for radiance with the directions exchanged.
  virtual Rgb evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const = 0;
  /// The density of sample() by solid angle, given that it samples `lobes`.
  virtual float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const = 0;
  /// Draws wi from `lobes`: u.z chooses the lobe, so that coupled frames choose alike. Nothing: absorbed.
  virtual std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const = 0;
  /// The chance that sampling all lobes would choose one of `lobes`, in [0, 1].
  virtual float share(const Vec3& wo, LobeSet lobes) const = 0;
  /// Some of `lobes` passes light through the surface.
  virtual bool transmits(LobeSet) const { return false; }
  /// f where it is the same for all pairs of directions on the outer (ng) or both sides, and black through the surface:
  /// gathering then sums flux first and multiplies once (of light on the wrong side of ns the gatherer takes care).
  /// Nothing for all else.
  virtual std::optional<Rgb> lambertian(LobeSet) const { return std::nullopt; }
  /// f over that of `other`, a scattering at the same point, where that is one colour for all directions: what differs
  /// in colour only is then evaluated once. Nothing where it is not, or cannot be told.
  virtual std::optional<Rgb> ratio_to(const Bsdf& /*other*/, LobeSet) const { return std::nullopt; }

 protected:
  ~Bsdf() = default;
};

/// Room for any Bsdf in place, so that a hit needs no allocation. Copying copies bytes, which is sound on the compilers
/// we build with because a Bsdf owns nothing and has no virtual base.
class BsdfSlot {
 public:
  static constexpr std::size_t kSize = 96;

  template <class T, class... Args>
  const Bsdf& emplace(Args&&... args) {
    static_assert(std::is_base_of_v<Bsdf, T>, "what a BsdfSlot holds is derived from Bsdf");
    static_assert(sizeof(T) <= kSize,
                  "this Bsdf takes more than the 96 bytes of a BsdfSlot: keep what is the same "
                  "for all points in the Material and a pointer to it here");
    static_assert(alignof(T) <= 8, "this Bsdf is aligned to more than 8 bytes: keep SIMD values as plain floats");
    static_assert(std::is_trivially_destructible_v<T>,
                  "a Bsdf is copied byte by byte and never destroyed: it may own "
                  "no memory");
    return *new (bytes_) T{std::forward<Args>(args)...};
  }
  /// `bsdf` must live in another slot.
  static BsdfSlot copy_of(const Bsdf& bsdf) { return *reinterpret_cast<const BsdfSlot*>(&bsdf); }
  const Bsdf& operator*() const { return *std::launder(reinterpret_cast<const Bsdf*>(bytes_)); }
  const Bsdf* operator->() const { return &**this; }

 private:
  alignas(8) std::byte bytes_[kSize];
};

}  // namespace dspm
