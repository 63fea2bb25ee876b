// mix: at each point one of two materials, chosen by chance; from afar, a blend of both.
//
//   MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [.7 .1 .1]
//   MakeNamedMaterial "rust" "string type" "diffuse" "rgb reflectance" [.3 .15 .05]
//   Material "mix" "string materials" ["paint" "rust"] "texture amount" "scratches"
//
//   materials   two names       required   materials by name, defined anywhere in the scene; mixes among them
//   amount      float texture   0.5        the share of the second one; 0 and less: the first alone, 1 and more: the second
//
// The choice is a function of the point alone, like a texture of white noise: camera paths and photons agree about it,
// frames share it, and where an amount is keyed, points change one by one. pbrt also makes it a function of the viewing
// direction, so that a point is not the same for light that arrives and light that leaves. Each material keeps its own
// relief, which a sum of both scattering functions could not have; but photons around a point count by the mean of both.
// A body has one inside: where both materials are glass, they must absorb alike, and rust on coloured glass leaves the
// body its colour.
#include "dspm/materials/mix.h"

#include <fmt/format.h>

#include <bit>

#include "dspm/colour/rgb.h"
#include "dspm/materials/parameters.h"
#include "dspm/math/rng.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

using Parts = MixMaterial::Parts;

/// Mixes within mixes choose independently.
float number_at(const Vec3& p, int depth) {
  std::uint64_t bits = static_cast<std::uint64_t>(depth);
  for (const float coordinate : {p.x, p.y, p.z})
    bits = mix_bits(bits * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(coordinate) + 1);
  return static_cast<float>(bits >> 40) * 0x1p-24f;
}

/// Both, or none after an error.
Parts find_parts(ParamReader& reader, const std::vector<std::string>& names, const MaterialContext& context) {
  Parts parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] = context.materials.find(names[i]);
    if (parts[i] == nullptr) return {};  // its own error has been reported
    if (parts[i]->is_seen()) continue;
    reader.error("materials", "material \"" + names[i] + "\" of " + reader.subject() + " is an interface",
                 "a shape with holes is one with \"alpha\"");
    return {};
  }
  return parts;
}

}  // namespace

const Material* MixMaterial::chosen(const SurfacePoint& point, int depth) const {
  const float amount = amount_->evaluate(texture_point(point));
  if (!(amount > 0)) return parts_[0].get();
  return parts_[amount >= 1 || number_at(point.p, depth) < amount ? 1 : 0].get();
}

std::unique_ptr<Material> make_mix(ParamReader& reader, const MaterialContext& context) {
  const std::vector<std::string> names = reader.texts("materials", "the names of two materials");
  const auto amount = reader.number_or_texture("amount", 0.5f, "", "the share of the second one");
  reader.finish();
  if (names.size() != 2) {
    reader.error("materials", reader.subject() + " takes the names of two materials",
                 "\"string materials\" [\"paint\" \"rust\"]");
    return nullptr;
  }
  Parts parts = find_parts(reader, names, context);
  if (parts[0] == nullptr || parts[1] == nullptr) return nullptr;
  if (parts[0]->bounds_a_body() && parts[1]->bounds_a_body() && parts[0]->absorption() != parts[1]->absorption())
    reader.error(
        "materials",
        fmt::format("\"{}\" and \"{}\" absorb light differently, but a body has one inside", names[0], names[1]),
        "give both the same \"attenuationcolor\" and \"attenuationdistance\"");
  return std::make_unique<MixMaterial>(std::move(parts), texture_of(amount, context.textures, reader.diagnostics()));
}

}  // namespace dspm
