#include "dspm/world/objects/look.h"

namespace dspm {
namespace {

const std::vector<MaterialUse>& replacements(const Variation& variation, const MaterialUse&) {
  return variation.materials;
}
const std::vector<TextureUse>& replacements(const Variation& variation, const TextureUse&) {
  return variation.textures;
}
const std::vector<MediumUse>& replacements(const Variation& variation, const MediumUse&) { return variation.media; }

Definition::Use use_of(const MaterialUse& use) { return {&use, nullptr}; }
Definition::Use use_of(const TextureUse& use) { return {&use, &use.world_from_texture}; }
Definition::Use use_of(const MediumUse& use) { return {&use, &use.world_from_medium}; }

bool replaces(const MediumUse& use, const MediumUse& own) { return use.name == own.name; }
bool replaces(const MaterialUse& use, const MaterialUse& own) { return !own.name.empty() && use.name == own.name; }
bool replaces(const TextureUse& use, const TextureUse& own) {
  return !own.name.empty() && use.name == own.name && use.is_spectrum == own.is_spectrum;
}

template <class AnyUse>
Definition definition(const SceneDescription& scene, const AnyUse& own) {
  constexpr std::size_t kOwn = 0;
  const std::vector<Combination>& combinations = scene.frames.combinations();
  Definition result{{use_of(own)}, std::vector(combinations.size(), kOwn)};
  for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
    const std::vector<Variation>& variations = scene.axes[axis].variations;
    std::vector<std::size_t> of_choice(variations.size(), kOwn);
    for (std::size_t v = 0; v < variations.size(); ++v)
      for (const AnyUse& use : replacements(variations[v], own)) {
        if (!replaces(use, own)) continue;
        of_choice[v] = result.uses.size();
        result.uses.push_back(use_of(use));
      }
    for (std::size_t c = 0; c < combinations.size(); ++c)
      if (const std::size_t use = of_choice[static_cast<std::size_t>(combinations[c].choices[axis])]; use != kOwn)
        result.use_of[c] = use;
  }
  return result;
}

}  // namespace

Definition definition_of(const SceneDescription& scene, const MaterialUse& own) { return definition(scene, own); }
Definition definition_of(const SceneDescription& scene, const TextureUse& own) { return definition(scene, own); }
Definition definition_of(const SceneDescription& scene, const MediumUse& own) { return definition(scene, own); }

}  // namespace dspm
