// Translates materials of glTF into those of the scene language, all of them "principled".
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dspm/lang/gltf/document.h"
#include "dspm/lang/gltf/statements.h"

namespace dspm::gltf {

/// The properties of a mesh, beside its positions, that materials need to know.
struct MeshLook {
  bool has_colours = false, has_opacities = false;

  friend auto operator<=>(const MeshLook&, const MeshLook&) = default;
};

/// The form that an animated material's statements have in every frame, so that they can be keyed.
struct MaterialForm {
  bool is_keyed = false, emits = false;
};

/// Statements that make one material: textures first, the material last. Names of textures begin with `name`.
struct MaterialStatements {
  std::vector<Statement> textures;
  Statement material;               // its head is `"principled"` alone
  std::optional<Statement> medium;  // inside of the material's bodies; its head is `"homogeneous"` alone
};

class Materials {
 public:
  /// `picture_name` returns the name of images/index in the scene's text.
  Materials(const Document& document, std::function<std::string(std::size_t)> picture_name)
      : document_(document), picture_name_(std::move(picture_name)) {}

  /// Translates `material` of the document, or of it at some moment; one that does not exist is glTF's default.
  MaterialStatements translate(const Value& material, const std::string& name, const MeshLook& look,
                               const MaterialForm& form = {});

  /// Notes of what dspm does not have, each once.
  const std::set<std::string>& notes() const { return notes_; }

 private:
  friend class MaterialTranslator;
  const Document& document_;
  std::function<std::string(std::size_t)> picture_name_;
  std::set<std::string> notes_;
};

}  // namespace dspm::gltf
