// A named texture or material: its recipe in each frame of the file, and what has been made of it so far.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/materials/material.h"
#include "dspm/textures/texture.h"
#include "dspm/world/objects/likeness.h"
#include "dspm/world/objects/timeline.h"

namespace dspm {

/// All definitions of a name: the scene's own first, then those that replace it in variations.
struct Definition {
  struct Use {
    const PluginUse* plugin;
    const Motion* motion;  // null: no placement
    bool is_keyed() const { return plugin->params.is_keyed() || (motion && motion->is_keyed()); }
  };
  std::vector<Use> uses;
  std::vector<std::size_t> use_of;  // by combination of variations
};

/// Returns the definition of a name. If two axes replace it, the later one wins.
Definition definition_of(const SceneDescription& scene, const MaterialUse& own);
Definition definition_of(const SceneDescription& scene, const TextureUse& own);
Definition definition_of(const SceneDescription& scene, const MediumUse& own);

template <class T>
struct Look;

/// A texture or material that parameters name, in one of its states.
template <class T>
struct Ingredient {
  std::string name;
  const Look<T>* look;
  int state;
  friend bool operator==(const Ingredient& a, const Ingredient& b) { return a.look == b.look && a.state == b.state; }
};

/// The ingredients of a texture or material: equal recipes make equal objects.
struct Recipe {
  const PluginUse* use = nullptr;
  ParamList params;  // of one moment
  Matrix4 placement;
  std::vector<Ingredient<FloatTexture>> numbers;
  std::vector<Ingredient<RgbTexture>> colours;
  std::vector<Ingredient<Material>> materials;
  std::vector<Ingredient<Material>> opacities = {};  // named textures of numbers: how much of these materials is there
  friend bool operator==(const Recipe& a, const Recipe& b) {
    return a.use->type == b.use->type && a.placement == b.placement && a.numbers == b.numbers &&
           a.colours == b.colours && a.materials == b.materials && a.opacities == b.opacities &&
           a.params.same_values(b.params);
  }
};

template <class T>
void add_ingredients(Likeness& likeness, const std::vector<Ingredient<T>>& ingredients) {
  for (const Ingredient<T>& each : ingredients) likeness.add(static_cast<const void*>(each.look)).add(each.state);
}

inline std::uint64_t likeness_of(const Recipe& recipe) {
  Likeness all;
  all.add(recipe.placement).add(recipe.params);
  add_ingredients(all, recipe.numbers), add_ingredients(all, recipe.colours), add_ingredients(all, recipe.materials);
  add_ingredients(all, recipe.opacities);
  return all.number();
}

template <class T>
struct Look {
  Timeline<Recipe> recipes;
  mutable std::vector<std::weak_ptr<const T>> made;  // by state
  std::vector<std::shared_ptr<const T>> kept;        // held even if no scene holds them
  std::vector<int> lookups;  // by state: texture lookups for one of this texture, at most kMostLookups
};

}  // namespace dspm
