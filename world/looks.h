// Textures and materials of a scene, with their states over the frames of the file.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lang/description.h"
#include "materials/material.h"
#include "textures/plugins.h"
#include "world/timeline.h"

namespace dspm {

using MaterialTimeline = Timeline<std::shared_ptr<const Material>>;

class Looks {
 public:
  Looks(const SceneDescription& description, Diagnostics& diagnostics);

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
  /// What a texture or material is made from in one frame; where it is equal, so is what is made.
  struct State {
    ParamList params;
    Matrix4 placement;
    std::vector<const void*> textures;  // that the parameters name
    Frame frame;                        // the first in which it holds
    friend bool operator==(const State& a, const State& b) {
      return a.placement == b.placement && a.textures == b.textures && a.params.same_values(b.params);
    }
  };

  void add_texture(const TextureUse& use);
  template <class T>
  void add_texture_of(const TextureUse& use);
  int add_material(const PluginUse& use, std::string name);
  Timeline<State> states_of(const ParamList& params, const Motion* motion) const;
  TextureSet& textures_at(Frame frame) {
    return textures_[textures_.size() == 1 ? 0 : static_cast<std::size_t>(frame)];
  }
  const TextureSet& textures_at(Frame frame) const { return const_cast<Looks*>(this)->textures_at(frame); }

  int frame_count_;
  std::filesystem::path main_directory_;
  Diagnostics& diagnostics_;
  ImageCache images_;
  std::vector<TextureSet> textures_;  // by frame, or one where no texture changes
  std::vector<MaterialTimeline> materials_;
  std::vector<std::string> names_;
  std::vector<int> of_use_;  // by index into SceneDescription::materials
  std::map<std::string, int> by_name_;
  std::map<std::string, int> from_files_;
  int default_ = -1;
};

}  // namespace dspm
