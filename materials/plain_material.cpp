#include "dspm/materials/plain_material.h"

#include <optional>

#include "dspm/base/colour/palette.h"
#include "dspm/materials/material.h"
#include "dspm/materials/refractive_index.h"

namespace dspm {

std::optional<PlainMaterial> Material::plain(const Palette& palette, const PlainIndex& outside) const {
  if (relief_ != nullptr || scatters_inside()) return std::nullopt;
  return plain_within(palette, outside);
}
std::optional<PlainMaterial> Material::plain(const Palette& palette) const { return plain(palette, {}); }

std::optional<PlainMaterial> Material::plain_look(const Palette&) const { return std::nullopt; }
std::optional<PlainMaterial> Material::plain_within(const Palette& palette, const PlainIndex&) const {
  return plain_look(palette);
}

}  // namespace dspm
