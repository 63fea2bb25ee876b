#include "dspm/materials/plain_material.h"

#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/materials/material.h"

namespace dspm {

std::optional<PlainMaterial> Material::plain(const Palette& palette) const {
  const bool has_empty_body = !scatters_inside() && is_black(absorption(palette));
  if (relief_ != nullptr || priority_ != 0 || !has_empty_body) return std::nullopt;
  return plain_look(palette);
}

std::optional<PlainMaterial> Material::plain_look(const Palette&) const { return std::nullopt; }

}  // namespace dspm
