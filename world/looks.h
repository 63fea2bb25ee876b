// Textures and materials of a scene, with their states over the frames of the file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lang/description.h"
#include "materials/material.h"
#include "world/timeline.h"

namespace dspm {

using MaterialTimeline = Timeline<std::shared_ptr<const Material>>;

class Looks {
 public:
  Looks(const SceneDescription& description, Diagnostics& diagnostics);
  ~Looks();

  /// Index into materials() of the material in force, pbrt's default for none; an unknown name is an error.
  int find(const MaterialRef& ref);
  /// A material that a geometry file brought along.
  int add(const FileMaterial& material, const SourceLocation& where);
  const std::vector<MaterialTimeline>& materials() const { return materials_; }
  /// Light passes into bodies of this material, in some frame.
  bool bounds_a_body(int material) const;
  /// `material "glass"`, for messages.
  const std::string& name_of(int material) const { return names_[static_cast<std::size_t>(material)]; }

 private:
  struct Textures;
  int add(const PluginUse& use, std::string name);

  const SceneDescription& description_;
  Diagnostics& diagnostics_;
  std::unique_ptr<Textures> textures_;
  std::vector<MaterialTimeline> materials_;
  std::vector<std::string> names_;
  std::vector<int> index_of_use_;  // of SceneDescription::materials; -1: not made yet
  int default_ = -1;
};

}  // namespace dspm
