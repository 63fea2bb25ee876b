#include "dspm/materials/principled/principled_bsdf.h"

#include <algorithm>
#include <cmath>
#include <typeinfo>

#include "dspm/base/math/sampling.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/principled/principled_layers.h"
#include "dspm/materials/rough_boundary.h"

namespace dspm {

Principled::Principled(const ShadingFrame& frame, const PrincipledTables& tables, const Refraction& refraction,
                       const Palette& palette, const PrincipledLook& look)
    : tables_(&tables),
      palette_(&palette),
      ns_(frame.ns()),
      ng_(frame.ng()),
      eta_(tables.thin ? tables.eta : refraction.eta),
      wavelength_(refraction.wavelength),
      tangent_(frame.x()),
      coat_normal_(frame.local(look.coat_normal, 1)),
      base_(look.base),
      sheen_(look.sheen),
      straight_(look.straight),
      beyond_colour_(look.beyond_colour),
      metallic_(look.metallic),
      specular_(look.specular),
      transmission_(look.transmission),
      beyond_(look.beyond),
      alpha_x_(look.alpha.x),
      alpha_y_(look.alpha.y),
      coat_(look.coat),
      coat_alpha_(look.coat_alpha),
      sheen_alpha_(look.sheen_alpha),
      film_(look.film),
      film_thickness_(look.film_nm / kMostFilmNm),
      diffuse_norm_(0) {
  diffuse_norm_ = SmallNumber(PrincipledLayers(*this).diffuse_norm());
}

LobeSet Principled::lobes(float least_alpha) const { return PrincipledLayers(*this).lobes(least_alpha); }

Spectrum Principled::evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
  const ShadingFrame frame = this->frame();
  const LocalPair w(frame, wo, wi, transport);
  if (!w.valid) return {};
  const Spectrum f = PrincipledLayers(*this, frame, w.side).f(w.wo, w.wi, transport, lobes);
  return f * hue_of(w.side, !w.reflection());
}

float Principled::pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
  const ShadingFrame frame = this->frame();
  const LocalPair w(frame, wo, wi, transport);
  if (!w.valid) return 0;
  const PrincipledLayers layers(*this, frame, w.side);
  return w.share * layers.density(w.wo, w.wi, transport, layers.chances(w.wo, transport, lobes));
}

std::optional<BsdfSample> Principled::sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
  const ShadingFrame frame = this->frame();
  const float side = frame.side(wo);
  const auto arriving = frame.arrive(wo, side, transport);
  if (!arriving) return std::nullopt;
  const Vec3 o = *arriving;
  const PrincipledLayers layers(*this, frame, side);
  const PrincipledChances chances = layers.chances(o, transport, lobes);
  const auto drawn = layers.draw(o, u, transport, chances);
  if (!drawn) return std::nullopt;
  const auto leaving = frame.leave(drawn->i, side, transport, u.x);
  if (!leaving) return std::nullopt;
  const float scale = drawn->refracted ? transport_scale(transport, layers.eta()) : 1;
  const bool beyond = drawn->i.z < 0;
  BsdfSample sample{leaving->wi, hue_of(side, beyond), 0, drawn->specular, scale};
  sample.by_wavelength = is_dispersive(side, beyond);
  if (drawn->specular) {
    sample.weight *= drawn->weight * (scale / leaving->share);
    return sample;
  }
  const float pdf_w = leaving->share * layers.density(o, drawn->i, transport, chances);
  if (!(pdf_w > 0)) return std::nullopt;
  sample.weight *= layers.f(o, drawn->i, transport, lobes) * (std::abs(drawn->i.z) / pdf_w), sample.pdf_w = pdf_w;
  return sample;
}

float Principled::lobe_probability(const Vec3& wo, LobeSet lobes) const {
  const ShadingFrame frame = this->frame();
  const float side = frame.side(wo);
  const PrincipledLayers layers(*this, frame, side);
  Vec3 o = frame.local(wo, side);
  o.z = std::abs(o.z);
  return layers.chances(o, Transport::flux, layers.lobes(0)).of(lobes);
}

bool Principled::is_dispersive(float side, bool passes) const {
  if (wavelength_.nm == 0 || tables_->thin || transmission_ == 0 || metallic_ == 1) return false;
  return passes || refraction().mirrors_by_wavelength(side);
}

bool Principled::differs_in_base_from(const Principled& o) const {
  return *tables_ == *o.tables_ && eta_ == o.eta_ && wavelength_ == o.wavelength_ && ns_ == o.ns_ && ng_ == o.ng_ &&
         tangent_ == o.tangent_ && coat_normal_ == o.coat_normal_ && film_ == o.film_ &&
         film_thickness_ == o.film_thickness_ && sheen_ == o.sheen_ && metallic_ == o.metallic_ &&
         specular_ == o.specular_ && straight_ == o.straight_ && transmission_ == o.transmission_ &&
         beyond_ == o.beyond_ && (beyond_ == 0 || beyond_colour_ == o.beyond_colour_) && alpha_x_ == o.alpha_x_ &&
         alpha_y_ == o.alpha_y_ && coat_ == o.coat_ && coat_alpha_ == o.coat_alpha_ && sheen_alpha_ == o.sheen_alpha_;
}

std::optional<Spectrum> Principled::ratio_to(const Bsdf& other, LobeSet lobes) const {
  if (typeid(other) != typeid(Principled)) return std::nullopt;
  const auto& o = static_cast<const Principled&>(other);
  if (!differs_in_base_from(o)) return std::nullopt;
  if (base_ == o.base_) return Spectrum(1);
  const LobeSet known = lobes & this->lobes(0);
  const bool one_colour = known == kThrough || (known == kDiffuse && PrincipledLayers(*this).only_diffuse());
  if (!one_colour) return std::nullopt;
  const auto of_base = ratio<Spectrum>(base_, o.base_);
  if (!of_base || known == kDiffuse || tables_->thin) return of_base;
  return map(*of_base, [](float c) { return std::sqrt(c); });
}

}  // namespace dspm
