// Collects which materials of the scene language a document's primitives need, and what the variants replace them with.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dspm/lang/gltf/animation.h"
#include "dspm/lang/gltf/materials.h"
#include "dspm/lang/gltf/names.h"

namespace dspm::gltf {

class MaterialUses {
 public:
  MaterialUses(const Document& document, const Animation& animation, int frames, double fps, Materials& materials,
               std::string prefix)
      : document_(document),
        animation_(animation),
        frames_(frames),
        fps_(fps),
        materials_(materials),
        prefix_(std::move(prefix)) {}

  /// Returns the name of the primitive's material, which is defined when it is first asked for.
  std::string name_of(const Value& primitive);

  /// Returns the name of the medium that fills the primitive, whose name_of() has been asked for; empty if there is none.
  std::string medium_of(const Value& primitive) const;

  const std::string& definitions() const { return definitions_; }
  /// Returns an axis with the file's variants; empty if there are none that change anything.
  std::string axis();

 private:
  /// Primitives that have the same material in every variant share one.
  struct Key {
    std::optional<std::size_t> material;
    std::map<std::size_t, std::size_t> of_variant;
    MeshLook look;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  Key key_of(const Value& primitive) const;
  /// Defines the textures, and returns what follows the material's name.
  std::string define(std::optional<std::size_t> material, const MeshLook& look);
  Value material_of(std::optional<std::size_t> material, const Json& json) const;

  const Document& document_;
  const Animation& animation_;
  int frames_;
  double fps_;
  Materials& materials_;
  std::string prefix_;
  Names names_, texture_names_;
  std::map<Key, std::string> uses_;
  std::vector<std::pair<Key, std::string>> replaceable_;
  std::map<std::pair<std::optional<std::size_t>, MeshLook>, std::string> defined_;
  std::map<std::optional<std::size_t>, std::string> media_;  // by material
  std::string definitions_;
};

}  // namespace dspm::gltf
