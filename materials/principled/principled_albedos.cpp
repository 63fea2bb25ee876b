// Computes what the layers of the principled material leave to each other, by the tables of their albedos.
#include <algorithm>
#include <cmath>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/principled/principled_layers.h"

namespace dspm {
namespace {

/// Returns LayerBalance's a.
float balanced(float left, float mean_left) { return left / std::sqrt(std::max(mean_left, 1e-4f)); }

}  // namespace

FacetAlbedo PrincipledLayers::of_metal() const {
  return {facets_.alpha(), tables_.common.metal, tables_.brushed_metal};
}
FacetAlbedo PrincipledLayers::of_dielectric() const {
  return {facets_.alpha(), tables_.boundary->outside.reflected, tables_.brushed_dielectric.get()};
}
FacetAlbedo PrincipledLayers::of_glass() const {
  if (thin_) return of_metal();
  const BrushedGlass* const brushed = tables_.brushed_glass.get();
  return {facets_.alpha(), boundary().reflected_or_refracted,
          brushed == nullptr ? nullptr
          : outside_         ? &brushed->outside
                             : &brushed->inside};
}

float PrincipledLayers::left_by_sheen(float cos) const {
  return sheen_weight_ > 0 ? 1 - sheen_weight_ * tables_.common.sheen.of(cos, sheen_alpha_) : 1;
}
float PrincipledLayers::mirrored_by_coat(float cos) const {
  if (coat_ == 0) return 0;
  return coat_ * (smooth_coat_ ? fresnel_dielectric(cos, kCoatEta) : tables_.common.coat.of(cos, coat_alpha_));
}

/// Leaves out what is uncertain, to gain nothing: the balance of two layers is the product of theirs to 1% of the
/// light, and that over brushed facets is known to 3%.
float PrincipledLayers::under_layers(const Way& w) const {
  if (smooth_) return std::sqrt(w.left);
  float mean_left = 1 + 0.011f * coat_ * sheen_weight_ + 0.03f * narrowness_ * std::max(coat_, sheen_weight_);
  if (coat_ > 0) mean_left *= tables_.balances->coat.mean_left(coat_, w.coat, w.alpha, smooth_coat_ ? 0 : coat_alpha_);
  if (sheen_weight_ > 0) mean_left *= tables_.balances->sheen.mean_left(sheen_weight_, w.cos, w.alpha, sheen_alpha_);
  return balanced(w.left, mean_left);
}

float PrincipledLayers::coat_under_sheen(float cos) const {
  if (sheen_weight_ == 0) return 1;
  const float left = left_by_sheen(cos);
  if (smooth_coat_) return std::sqrt(left);
  return balanced(left, tables_.balances->sheen.mean_left(sheen_weight_, cos, coat_alpha_, sheen_alpha_));
}

PrincipledLayers::Way PrincipledLayers::way(const Vec3& w, float cos_coat) const {
  Way way{std::abs(w.z), cos_coat, 0, alpha_, 1, 1};
  if (!is_isotropic_) {
    const Vec2 alpha = facets_.alpha();
    way.turn = BrushedAlbedo::turn(w, alpha);
    const float x = w.x * alpha.x, y = w.y * alpha.y;
    way.alpha = std::sqrt(x * x + y * y + w.z * w.z * alpha.x * alpha.y);
  }
  if (is_layered()) {
    way.left = left_by_sheen(way.cos) * (1 - mirrored_by_coat(cos_coat));
    way.share = under_layers(way);
  }
  return way;
}

/// Returns a direction as the layers see it. A coat that is seen from behind mirrors nothing.
PrincipledLayers::Way PrincipledLayers::way(const Vec3& w, const Tilts& tilts) const {
  const float base = std::abs(w.z), coat = w.z < 0 ? -tilts.coat.cosine(w) : tilts.coat.cosine(w);
  return way(w, coat > 0 ? std::min(base, coat) : base);
}

/// Returns what sheen and coat send back in of light that leaves a facet of glass from inside. Rough facets spread it,
/// so the lesser of what facet and directions say counts, to gain nothing.
float PrincipledLayers::sent_back(float cos_facet, const Way& o, const Way& i) const {
  if (outside_ || !is_layered()) return 0;
  const auto back = [&](float cos) {
    const float sin2_outside = (1 - cos * cos) / (eta() * eta());
    return sin2_outside >= 1 ? 0 : 1 - left_by_both(std::sqrt(1 - sin2_outside));
  };
  return std::min(back(cos_facet), std::max(back(o.cos), back(i.cos)));
}

/// Returns the share of its brightest colour. Facets under a film mirror no more than what the tables know and the
/// film's most gain.
float PrincipledLayers::mirrored_by_dielectric(const Way& w, float more) const {
  if (smooth_) {
    const float usual = max_component(dielectric_facet(w.cos, tables_.eta));
    return specular_ * std::max(0.f, usual + more * (1 - usual));
  }
  const float bare = of_dielectric().of(w.cos, w.turn);
  if (!film_ && more == 0) return specular_ * bare;
  const float all = of_metal().of(w.cos, w.turn);
  const float usual = film_ ? std::min(1.f, bare + under_film_ * tables_.film_gain * all) : bare;
  return specular_ * std::clamp(usual + more * (all - usual), 0.f, 1.f);
}

float PrincipledLayers::diffuse_norm() const {
  // Gauss and Legendre's rule of eight points on [0, 1].
  constexpr std::array<Vec2, 8> kRule{{{0.0198550718f, 0.0506142681f},
                                       {0.1016667613f, 0.1111905172f},
                                       {0.2372337950f, 0.1568533229f},
                                       {0.4082826788f, 0.1813418917f},
                                       {0.5917173212f, 0.1813418917f},
                                       {0.7627662050f, 0.1568533229f},
                                       {0.8983332387f, 0.1111905172f},
                                       {0.9801449282f, 0.0506142681f}}};
  if (opaque_ == 0) return 1;
  const int around = is_isotropic_ ? 1 : 4;
  float sum = 0;
  for (int k = 0; k < around; ++k) {
    const float phi = (static_cast<float>(k) + 0.5f) / static_cast<float>(around) * kPi / 2;
    for (const Vec2& point : kRule) {
      const float sin = std::sqrt(1 - point.x * point.x);
      sum += point.y * 2 * point.x *
             left_to_ground(way({sin * rounded::cos(phi), sin * rounded::sin(phi), point.x}, point.x));
    }
  }
  return sum / static_cast<float>(around);
}

/// Returns the lobe for light that meets several facets.
Spectrum PrincipledLayers::made_up_by_metal(const Way& o, const Way& i) const {
  const FacetAlbedo metal = of_metal();
  const float lost = made_up(1 - metal.of(o.cos, o.turn), 1 - metal.of(i.cos, i.turn), 1 - metal.mean()) *
                     (1 - kUnsureIfBrushed * narrowness_);
  return after_more_reflections(mean_by_metal(), metal.mean()) * (lost * o.share * i.share);
}

/// Returns the lobe for what glass loses. A film mirrors a share of what glass alone would let through (or less than
/// none), and facets lose of that what they lose of metal's.
Spectrum PrincipledLayers::made_up_by_glass(const Way& o, const Way& i) const {
  const FacetAlbedo glass = of_glass();
  const float sure = 1 - (outside_ ? kUnsureIfBrushed : kUnsureInsideIfBrushed) * narrowness_;
  const auto lost_by = [](const FacetAlbedo& facets, const Way& w) { return 1 - facets.of(w.cos, w.turn); };
  const float over = over_glass(o, i) * sure;
  const float bare_o = lost_by(glass, o), bare_i = lost_by(glass, i), bare = 1 - glass.mean();
  if (!film_) return Spectrum(over * made_up(bare_o, bare_i, bare));
  const FacetAlbedo metal = of_metal();
  const float more_o = lost_by(metal, o) - bare_o, more_i = lost_by(metal, i) - bare_i, more = 1 - metal.mean() - bare;
  Spectrum share, sum;
  for (const float cos : {0.95f, 0.7f, 0.4f}) {
    const float usual = fresnel_dielectric(cos, tables_.eta);
    share += (dielectric_facet(cos, tables_.eta) - Spectrum(usual)) / (3 * (1 - usual));
  }
  for (int c = 0; c < 3; ++c) {
    const auto lost = [&](float alone, float rest) { return std::max(0.f, alone + share[c] * rest); };
    sum[c] = over * made_up(lost(bare_o, more_o), lost(bare_i, more_i), lost(bare, more));
  }
  return sum;
}

}  // namespace dspm
