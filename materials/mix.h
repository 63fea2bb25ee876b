// Materials that are one of two others at each point, and what may be next to the point.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/materials/material.h"
#include "dspm/textures/plain_part.h"
#include "dspm/textures/texture.h"

namespace dspm {

class MixMaterial final : public Material {
 public:
  using Parts = std::array<std::shared_ptr<const Material>, 2>;

  MixMaterial(Parts parts, TexturePtr<float> amount)
      : parts_(std::move(parts)), amount_(std::move(amount)), plain_amount_(amount_) {
    set_priority(body().priority());
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override { return at(point).bsdf(point, slot); }
  bool bounds_a_body() const override { return parts_[0]->bounds_a_body() || parts_[1]->bounds_a_body(); }
  Spectrum absorption(const Palette& palette) const override { return body().absorption(palette); }
  float eta() const override { return body().eta(); }
  float eta_at(const Wavelength& wavelength) const override { return body().eta_at(wavelength); }
  bool disperses() const override { return parts_[0]->disperses() || parts_[1]->disperses(); }
  bool scatters_inside() const override { return parts_[0]->scatters_inside() || parts_[1]->scatters_inside(); }
  bool is_seen() const override { return parts_[0]->is_seen() || parts_[1]->is_seen(); }
  const Material* chosen(const SurfacePoint& point, int depth) const override;
  const Parts& parts() const { return parts_; }

  /// Both parts' holes, as textures of how much of them is there; null if all of it is. Set once, when the material is
  /// made.
  using Opacities = std::array<TexturePtr<float>, 2>;
  void set_opacities(Opacities opacities);
  /// Returns how much of the mix is there; null if all of it is.
  const TexturePtr<float>& opacity() const { return opacity_; }
  /// Returns how much of a point each part covers, which adds up to the opacity.
  std::array<float, 2> cover(const TexturePoint& at) const { return cover_of(*amount_, opacities_, at); }

 private:
  class Opacity;
  /// Returns nullopt if a part has no plain form, has holes or is a mix itself.
  std::optional<PlainMaterial> plain_within(const Palette& palette, const PlainIndex& outside) const override;
  /// Returns the part that bounds a body; if both do, they absorb alike, and the first one counts.
  const Material& body() const { return *parts_[parts_[0]->bounds_a_body() ? 0 : 1]; }
  static std::array<float, 2> cover_of(const FloatTexture& amount, const Opacities& opacities, const TexturePoint& at);

  Parts parts_;
  TexturePtr<float> amount_;
  PlainPart<float> plain_amount_;
  Opacities opacities_;
  TexturePtr<float> opacity_;
};

/// Returns whether `holds(const Material&)` for some seen material that the mix is made of; any other material is
/// tested itself.
template <class Holds>
bool any_part(const Material& material, Holds&& holds) {
  const auto* mix = dynamic_cast<const MixMaterial*>(&material);
  if (mix == nullptr) return material.is_seen() && holds(material);
  return any_part(*mix->parts()[0], holds) || any_part(*mix->parts()[1], holds);
}

}  // namespace dspm
