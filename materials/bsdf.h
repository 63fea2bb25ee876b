// Scattering at one point of a surface: what a material becomes once its textures are looked up there. All directions
// are in world space, of unit length, and point away from the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/interior.h"

namespace dspm {

/// The quantity that a path carries. Refraction scales radiance by (eta_i/eta_t)^2 and leaves flux alone. [Veach 1997,
/// 5.2]
enum class Transport { radiance, flux };

/// A subset of a Bsdf's lobes, one bit each.
using LobeSet = std::uint8_t;

struct BsdfSample {
  Vec3 wi;
  Spectrum weight;  // f |cos(wi, ns)| / pdf_w; for a specular lobe: its albedo over the probability of its choice
  float pdf_w;      // by solid angle, over the requested lobes; 0 if specular
  bool specular;    // the direction was the only possible one: pdf_w and evaluate ignore it
  // The factor of refraction on radiance, (eta_i/eta_t)^2, which is undone on the way out: Russian roulette ignores it.
  float eta_scale = 1;
  // Of the boundary of a body that scatters inside: what lies along wi, nothing if that is outside. Else nullopt.
  std::optional<Interior> ahead = std::nullopt;
  // Only light of SurfacePoint::wavelength goes this way: the weight has the factor hue_on_refraction() of that.
  bool by_wavelength = false;
};

/// Plain values without owned memory: a Bsdf may be copied byte by byte (see BsdfSlot).
class Bsdf {
 public:
  /// The lobes whose roughness is at least `least_alpha`: GGX alpha, 0 for specular; diffuse lobes always count.
  virtual LobeSet lobes(float least_alpha) const = 0;
  LobeSet all_lobes() const { return lobes(0); }
  /// f(wo, wi) in 1/sr, without the cosine, summed over `lobes`; specular lobes add nothing. The geometric normal
  /// distinguishes reflection from transmission; if it and ns disagree about the side that light comes from (wi for
  /// radiance, wo for flux), f is 0. So f for flux is f for radiance with the directions exchanged; the cosines of
  /// fibres (hair.cpp) are those of a surface that turns to each ray.
  virtual Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const = 0;
  /// The density of sample() by solid angle, given that it samples `lobes`.
  virtual float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const = 0;
  /// Samples wi from `lobes`; nullopt if the light is absorbed. u.z chooses the lobe, so that coupled frames choose
  /// alike.
  virtual std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const = 0;
  /// The probability that sampling all lobes would choose one of `lobes`, in [0, 1].
  virtual float lobe_probability(const Vec3& wo, LobeSet lobes) const = 0;
  /// Returns whether any of `lobes` transmits light through the surface.
  virtual bool transmits(LobeSet) const { return false; }
  /// Returns whether w leads into a body that scatters inside: nothing is seen in a straight line there.
  virtual bool enters(const Vec3& /*w*/) const { return false; }
  /// Returns whether light between these directions goes by its wavelength: f is then that of SurfacePoint::wavelength, times
  /// its hue_on_refraction().
  virtual bool disperses(const Vec3& /*wo*/, const Vec3& /*wi*/) const { return false; }
  /// Returns f if it is the same for all pairs of directions on the outer (ng) side or on both sides, and black through
  /// the surface; otherwise nullopt. Gathering then sums flux first and multiplies once; it handles light on the wrong
  /// side of ns itself.
  virtual std::optional<Spectrum> lambertian(LobeSet) const { return std::nullopt; }
  /// Returns f over the f of `other`, a Bsdf at the same point, if the ratio is one colour for all directions: Bsdfs
  /// that differ only in colour are then evaluated once. Returns nullopt if it is not, or if it is not known.
  virtual std::optional<Spectrum> ratio_to(const Bsdf& /*other*/, LobeSet) const { return std::nullopt; }

 protected:
  ~Bsdf() = default;
};

/// Room for any Bsdf in place, so that a hit needs no allocation. Copying copies bytes, which is sound with the
/// compilers that we use because a Bsdf owns nothing and has no virtual base.
class BsdfSlot {
 public:
  static constexpr std::size_t kSize = 112;

  template <class T, class... Args>
  const Bsdf& emplace(Args&&... args) {
    static_assert(std::is_base_of_v<Bsdf, T>, "a class in a BsdfSlot must be derived from Bsdf");
    static_assert(sizeof(T) <= kSize,
                  "this Bsdf is larger than the 112 bytes of a BsdfSlot: keep the data that all "
                  "points share in the Material, and a pointer to it here");
    static_assert(alignof(T) <= 8, "this Bsdf is aligned to more than 8 bytes: keep SIMD values as plain floats");
    static_assert(std::is_trivially_destructible_v<T>,
                  "a Bsdf is copied byte by byte and never destroyed: it must "
                  "not own memory");
    return *new (bytes_) T{std::forward<Args>(args)...};
  }
  /// Copies `bsdf`, which must live in another slot.
  static BsdfSlot copy_of(const Bsdf& bsdf) { return *reinterpret_cast<const BsdfSlot*>(&bsdf); }
  const Bsdf& operator*() const { return *std::launder(reinterpret_cast<const Bsdf*>(bytes_)); }
  const Bsdf* operator->() const { return &**this; }

 private:
  alignas(8) std::byte bytes_[kSize];
};

}  // namespace dspm
