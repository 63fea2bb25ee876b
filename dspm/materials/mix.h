// Materials that are one of two others at each point, and what may be next to the point.
#pragma once

#include <array>
#include <memory>

#include "dspm/colour/rgb.h"
#include "dspm/materials/material.h"
#include "dspm/textures/texture.h"

namespace dspm {

class MixMaterial final : public Material {
 public:
  using Parts = std::array<std::shared_ptr<const Material>, 2>;

  MixMaterial(Parts parts, TexturePtr<float> amount) : parts_(std::move(parts)), amount_(std::move(amount)) {}

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override { return at(point).bsdf(point, slot); }
  bool bounds_a_body() const override { return parts_[0]->bounds_a_body() || parts_[1]->bounds_a_body(); }
  /// Of the part that bounds a body; if both do, they absorb alike.
  Rgb absorption() const override { return parts_[parts_[0]->bounds_a_body() ? 0 : 1]->absorption(); }
  const Material* chosen(const SurfacePoint& point, int depth) const override;
  const Parts& parts() const { return parts_; }

 private:
  Parts parts_;
  TexturePtr<float> amount_;
};

/// Whether `holds(const Material&)` for some material that the mix is made of; of any other material, for itself.
template <class Holds>
bool any_part(const Material& material, Holds&& holds) {
  const auto* mix = dynamic_cast<const MixMaterial*>(&material);
  if (mix == nullptr) return holds(material);
  return any_part(*mix->parts()[0], holds) || any_part(*mix->parts()[1], holds);
}

}  // namespace dspm
