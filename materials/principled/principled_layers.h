// The layers of the principled material as formulas, for light from one side. Directions are in the shading frame, wo
// above. From the top: sheen, coat, and a base of three shares: metal, glass (which transmits) and an opaque dielectric
// over a diffuse ground. From inside, glass has no layers over it, as it has them on its other side. A thin wall is
// seen from outside on both sides.
#pragma once

#include <array>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/principled/principled_bsdf.h"
#include "dspm/materials/principled/sheen.h"
#include "dspm/materials/principled/tilt.h"
#include "dspm/materials/thin_film.h"

namespace dspm {

inline Vec3 other_side(const Vec3& w) { return {w.x, w.y, -w.z}; }

/// The probability with which each lobe is sampled, in the order of their bits.
struct PrincipledChances {
  std::array<float, 4> chance{};
  float beyond = 0;  // of the diffuse lobe: that it leaves on the other side
  float operator[](int lobe) const { return chance[static_cast<std::size_t>(lobe)]; }
  float of(LobeSet lobes) const {
    float sum = 0;
    for (int lobe = 0; lobe < 4; ++lobe)
      if (lobes >> lobe & 1) sum += (*this)[lobe];
    return sum;
  }
};

class PrincipledLayers {
 public:
  PrincipledLayers(const Principled& at, const ShadingFrame& frame, float side);
  /// Makes the layers as seen from outside, for what does not depend on directions.
  explicit PrincipledLayers(const Principled& at) : PrincipledLayers(at, at.frame(), 1) {}

  LobeSet lobes(float least_alpha) const;
  /// Returns whether the diffuse lobe is the base alone.
  bool only_diffuse() const;
  /// The index of refraction beyond the surface, over that on this side.
  float eta() const { return outside_ ? eta_ : 1 / eta_; }

  Spectrum f(const Vec3& o, const Vec3& i, Transport transport, LobeSet lobes) const;
  /// Returns the probabilities of sampling `lobes`; zero for those that do not exist.
  PrincipledChances chances(const Vec3& o, Transport transport, LobeSet lobes) const;
  /// Returns the density by solid angle.
  float density(const Vec3& o, const Vec3& i, Transport transport, const PrincipledChances& chances) const;

  struct Drawn {
    Vec3 i;
    bool specular;
    Spectrum weight = {};  // if it is; without the factor of refraction on radiance
    bool refracted = false;
  };
  std::optional<Drawn> draw(const Vec3& o, const Vec3& u, Transport transport, const PrincipledChances& chances) const;

  /// Returns what Principled::diffuse_norm_ keeps.
  float diffuse_norm() const;

 private:
  /// The tilts of the lobes that mirror.
  struct Tilts {
    Tilt facets, coat;
  };
  Tilts as_they_are() const { return {{}, Tilt(coat_normal_)}; }
  /// Returns the lobes as the camera sees them: bent where what they mirror of `camera` would go below the surface.
  Tilts as_seen(const Vec3& camera) const;
  /// Returns the lobes by which wi is sampled: light does not know yet who will see it.
  Tilts to_sample(const Vec3& o, Transport transport) const {
    return transport == Transport::radiance ? as_seen(o) : as_they_are();
  }
  /// A direction, which may lie below, as the layers see it.
  struct Way {
    float cos;    // to the surface's normal
    float coat;   // to the coat's or, if that is the less, the surface's
    float turn;   // BrushedAlbedo::turn
    float alpha;  // of facets that turn light up or down
    float left;   // by sheen and coat
    float share;  // of light that facets below both mirror: LayerBalance's a
  };
  Way way(const Vec3& w, const Tilts& tilts) const;
  Way way(const Vec3& w, float cos_coat) const;

  /// Directional albedos of the base's facets.
  FacetAlbedo of_metal() const;
  FacetAlbedo of_dielectric() const;  // what a boundary mirrors, from outside
  FacetAlbedo of_glass() const;       // what it mirrors or refracts
  const BoundaryAlbedos& boundary() const { return outside_ ? tables_.boundary->outside : tables_.boundary->inside; }

  bool is_layered() const { return coat_ > 0 || sheen_weight_ > 0; }
  float left_by_sheen(float cos) const;
  float mirrored_by_coat(float cos) const;
  float left_by_both(float cos) const { return left_by_sheen(cos) * (1 - mirrored_by_coat(cos)); }
  float under_layers(const Way& w) const;
  float coat_under_sheen(float cos) const;
  float over_glass(const Way& o, const Way& i) const { return outside_ ? o.share * i.share : 1; }
  float sent_back(float cos_facet, const Way& o, const Way& i) const;
  /// Returns the dielectric's directional albedo, if its colour mirrors that share more.
  float mirrored_by_dielectric(const Way& w, float more) const;
  float left_to_ground(const Way& w) const { return (1 - mirrored_by_dielectric(w, most_more_)) * w.left; }
  Spectrum made_up_by_metal(const Way& o, const Way& i) const;
  Spectrum made_up_by_glass(const Way& o, const Way& i) const;
  /// Return a facet's reflectance, by kind.
  Spectrum metal_facet(float cos) const;
  Spectrum mean_by_metal() const;
  Spectrum dielectric_facet(float cos, float eta) const;
  Spectrum opaque_facet(float cos) const;
  Spectrum glass_facet(float cos, float eta) const;
  Spectrum mirrored_by_facet(float cos_facet, const Way& o, const Way& i) const;
  Spectrum through_facet(float cos_facet, const Way& o, const Way& i) const;
  Spectrum through(const Vec3& o, const Vec3& i, const Way& way_o, const Way& way_i, Transport transport) const;
  Spectrum ground(const Way& o, const Way& i, bool beyond) const;
  Spectrum diffuse(const Vec3& o, const Vec3& i, const Way& way_o, const Way& way_i) const;
  PrincipledChances weights(const Way& o) const;
  float density_through(const Vec3& o, const Vec3& i) const;
  std::optional<Drawn> draw_specular(const Vec3& o, const Vec3& u, const Tilts& tilts, Transport transport,
                                     float chance) const;
  std::optional<Drawn> draw_through(const Vec3& o, const Vec3& u, float chance) const;
  std::optional<Drawn> draw_diffuse(const Vec3& u, float of_lobe, float beyond) const;
  std::optional<Drawn> draw_coat(const Vec3& o, const Vec3& u, const Tilts& tilts, Transport transport,
                                 float chance) const;

  const PrincipledTables& tables_;
  // Inside over outside, of what passes, and of what glass mirrors on this side; everything else is by that of the tables.
  float eta_, mirroring_eta_;
  bool thin_, outside_;
  Vec3 up_, coat_normal_;  // in the frame, on this side: the geometric normal, and the coat's
  Spectrum base_, sheen_, beyond_colour_;
  Spectrum more_;  // see opaque_facet
  float most_more_;
  float metal_, glass_, opaque_;     // shares of the base
  float beyond_;                     // share of the ground's light
  float specular_, coat_, covered_;  // covered: the share that has layers on this side
  Ggx facets_, coat_facets_;
  bool smooth_, smooth_coat_, is_isotropic_;
  float alpha_, coat_alpha_, sheen_alpha_;  // alpha_: the mean of both
  float narrowness_;                        // of brushed facets: 0 to 0.9
  float sheen_weight_, diffuse_norm_;
  float under_film_;  // share
  std::optional<ThinFilm> film_;
};

}  // namespace dspm
