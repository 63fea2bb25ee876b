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
// relief, which a sum of both scattering functions could not have; but photons around a point count by the mean of
// both. A part may have holes or be an "interface", which is nothing but a hole, and it may emit light: world gives the
// shape the holes and the light of both parts, each by its share.
// A body has one inside: where both materials are glass, they must absorb alike, and rust on coloured glass leaves the
// body its colour.
#include "dspm/materials/mix.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/plain_material.h"

namespace dspm {
namespace {

using Parts = MixMaterial::Parts;

/// Returns both parts; one is null after an error, which has been reported.
Parts find_parts(const std::vector<std::string>& names, const MaterialContext& context) {
  return {context.materials.find(names[0]), context.materials.find(names[1])};
}

}  // namespace

class MixMaterial::Opacity final : public FloatTexture {
 public:
  Opacity(TexturePtr<float> amount, Opacities of_parts) : amount_(std::move(amount)), of_parts_(std::move(of_parts)) {}

  float evaluate(const TexturePoint& at) const override {
    const auto [first, second] = cover_of(*amount_, of_parts_, at);
    return first + second;
  }
  std::optional<float> constant() const override {
    const auto is_constant = [](const TexturePtr<float>& texture) { return !texture || texture->constant(); };
    if (!is_constant(amount_) || !is_constant(of_parts_[0]) || !is_constant(of_parts_[1])) return std::nullopt;
    return evaluate({});
  }

 private:
  TexturePtr<float> amount_;
  Opacities of_parts_;
};

std::array<float, 2> MixMaterial::cover_of(const FloatTexture& amount, const Opacities& opacities,
                                           const TexturePoint& at) {
  const auto there = [&](std::size_t part) {
    return opacities[part] ? std::clamp(opacities[part]->evaluate(at), 0.f, 1.f) : 1.f;
  };
  const float second = std::clamp(amount.evaluate(at), 0.f, 1.f);
  return {(1 - second) * there(0), second * there(1)};
}

void MixMaterial::set_opacities(Opacities opacities) {
  opacities_ = std::move(opacities);
  if (opacities_[0] || opacities_[1]) opacity_ = std::make_shared<Opacity>(amount_, opacities_);
}

const Material* MixMaterial::chosen(const SurfacePoint& point, int depth) const {
  float amount = amount_->evaluate(texture_point(point));
  if (opacity_) {  // what is not there has let the ray through, so the rest is shared out
    const auto [first, second] = cover(texture_point(point));
    amount = first + second > 0 ? second / (first + second) : parts_[0]->is_seen() ? 0.f : 1.f;
  }
  return parts_[takes_second(amount, point.p, depth) ? 1 : 0].get();
}

std::optional<PlainMaterial> MixMaterial::plain_within(const Palette& palette, const PlainIndex& outside) const {
  const auto first = parts_[0]->plain(palette, outside), second = parts_[1]->plain(palette, outside);
  const auto amount = plain_amount_.value(palette);
  const bool is_one_of_two = first && first->everywhere() && second && second->everywhere();
  if (opacity_ || !is_one_of_two || !amount) return std::nullopt;
  return PlainMaterial(*first->everywhere(), *second->everywhere(), *amount);
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
  Parts parts = find_parts(names, context);
  if (parts[0] == nullptr || parts[1] == nullptr) return nullptr;
  if (parts[0]->bounds_a_body() && parts[1]->bounds_a_body() &&
      parts[0]->absorption(Palette::rgb()) != parts[1]->absorption(Palette::rgb()))
    reader.error(
        "materials",
        fmt::format("\"{}\" and \"{}\" absorb light differently, but a body has one inside", names[0], names[1]),
        "give both the same \"attenuationcolor\" and \"attenuationdistance\"");
  return std::make_unique<MixMaterial>(std::move(parts), texture_of(amount, context.textures, reader.diagnostics()));
}

}  // namespace dspm
