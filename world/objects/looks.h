// Textures and materials of a scene, with their states over the frames of the file. All of them are made once before
// rendering, so that errors show early. If there are many frames, those that only some frames need are made again for
// each scene that needs them.
#pragma once

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/emission_pattern.h"
#include "dspm/materials/material.h"
#include "dspm/textures/plugins.h"
#include "dspm/world/objects/distinct_names.h"
#include "dspm/world/objects/look.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The light that a material emits in one of its states, from both sides of its shapes.
struct MaterialLight {
  Rgb radiance;
  std::shared_ptr<const EmissionPattern> pattern = nullptr;  // null: the same everywhere
  std::shared_ptr<const SpectrumByNm> spectrum = nullptr;    // of the radiance; null: its colour says all
  bool is_dark() const { return is_black(radiance); }
  Rgb at(const SurfacePoint& point) const { return pattern ? radiance * pattern->at(point) : radiance; }
};

class Looks {
 public:
  /// `images` holds pictures of other looks of the same scene, and those of these.
  Looks(const SceneDescription& description, std::shared_ptr<ImageCache> images, Diagnostics& diagnostics);

  /// Returns the index of the current material, or of pbrt's default if there is none; an unknown name is an error.
  int find(const MaterialRef& ref);
  /// Adds a material from a geometry file, or returns the scene's of the same name.
  int add(const FileMaterial& material, const SourceLocation& where);
  /// Adds a texture of numbers without a name, of that type. Returns its index.
  int add_number(std::string type, ParamList params, const SourceLocation& where, bool blurs = true);
  /// Adds a parameter that is a number or names a texture, with keys or without. Returns its index.
  int add_number(ParamList value, const SourceLocation& where, bool blurs = true) {
    for (Param& param : value.params) param.name = "tex";
    return add_number("scale", std::move(value), where, blurs);
  }
  /// The number's state in each frame of the file.
  const std::vector<int>& states_of_number(int number) const { return numbers_[slot(number)].recipes.state_of; }
  /// Returns the texture in a state; throws SceneError if a file has changed since the first time.
  TexturePtr<float> number(int number, int state) const;
  /// Returns the number that is `of_shape` (-1 stands for 1) times the material's own alpha; `of_shape` itself if it
  /// has none.
  int opacity(int material, int of_shape);
  /// Returns its value in a state if it is the same everywhere. The value is unknown if only some frames of many need
  /// that state of the texture.
  std::optional<float> constant(int number, int state) const;
  /// Reports names that no material has. Variations may replace materials of geometry files, so call it once these have
  /// been read.
  void refuse_unknown_replacements();

  /// Returns the materials, by index, in these frames of the file. Throws SceneError if a file has changed since the
  /// first time.
  std::vector<FrameStates<Material>> materials_in(const std::vector<FileFrame>& frames) const;

  /// The number of pictures in memory for textures.
  int pictures_held() const { return images_->alive(); }
  const std::shared_ptr<ImageCache>& images() const { return images_; }

  int material_count() const { return static_cast<int>(materials_.size()); }
  /// The material's state in each frame of the file.
  const std::vector<int>& states_of(int material) const { return look(material).recipes.state_of; }
  /// Returns whether light passes into bodies of this material, in some frame.
  bool bounds_a_body(int material) const { return look(material).bounds_a_body; }
  /// Returns whether it emits light in some frame.
  bool emits(int material) const;
  const MaterialLight& light(int material, FileFrame frame) const {
    return look(material).lights[static_cast<std::size_t>(look(material).recipes.at(frame))];
  }
  /// Returns whether it bends normals in some frame.
  bool bends_normals(int material) const {
    const auto& states = look(material).recipes.states;
    return std::any_of(states.begin(), states.end(), [](const Recipe& recipe) {
      return recipe.params.find("normalmap") != nullptr || recipe.params.find("normaltexture") != nullptr ||
             recipe.params.find("displacement") != nullptr;
    });
  }
  /// The name that the scene or the geometry file gives it; empty if it has none.
  const std::string& own_name(int material) const { return look(material).own_name; }
  /// Returns whether its shapes are there in a frame of the file.
  bool is_seen(int material, FileFrame frame) const {
    return look(material).seen[static_cast<std::size_t>(look(material).recipes.at(frame))];
  }
  /// Returns its definition in a frame of the file.
  const PluginUse& use_of(int material, FileFrame frame) const {
    const Timeline<Recipe>& recipes = look(material).recipes;
    return *recipes.states[static_cast<std::size_t>(recipes.at(frame))].use;
  }
  /// Returns `material "glass"`, for messages.
  const std::string& name_of(int material) const { return look(material).name; }
  /// Distinct names by index: what the scene or the geometry file calls the material, else its type.
  const std::vector<std::string>& material_names() const { return material_names_.all(); }

 private:
  struct MaterialLook : Look<Material> {
    std::string name, own_name;
    bool bounds_a_body = false;
    std::vector<bool> has_open_parts;   // by state: of a mix
    std::vector<bool> seen;             // by state
    std::vector<MaterialLight> lights;  // likewise
  };
  template <class T>
  struct Textures {
    std::deque<Look<Texture<T>>> looks;  // addresses are stable
    std::map<std::string, const Look<Texture<T>>*> by_name;
  };

  static std::size_t slot(int index) { return static_cast<std::size_t>(index); }
  const MaterialLook& look(int material) const { return materials_[static_cast<std::size_t>(material)]; }
  template <class T>
  const Textures<T>& textures() const {
    return std::get<Textures<T>>(textures_);
  }

  void add_lights(MaterialLook& look) const;
  MaterialLight own_light(const MaterialLook& look, const Recipe& recipe) const;
  MaterialLight mixed_light(const MaterialLook& look, int state) const;
  bool has_holes(const MaterialLook& look, int state) const;
  /// Returns how much of a material is there; null if all of it is.
  TexturePtr<float> opacity_of(const Ingredient<Material>& material, Diagnostics& diagnostics) const;
  /// Returns the recipe for the shape's number in a state (-1 for none) times how much of the material is there in a
  /// state.
  Recipe opacity_recipe(const TextureUse& use, const MaterialLook& material, int state, int of_shape,
                        int state_of_shape) const;

  void add_texture(const TextureUse& own);
  template <class T>
  void add_texture_of(const TextureUse& own);
  /// Adds a material of the description, after those that it names. Returns its index, -1 after an error.
  int add_with_parts(std::size_t use, int depth);
  /// Sets the look's recipes and makes its states.
  template <class T>
  void look_at_texture(Look<Texture<T>>& look, const TextureUse& own);
  template <class T>
  void make_states(Look<Texture<T>>& look, const TextureUse& own);
  /// Adds a material. `name` is for messages; for `public_name`, see material_names.
  int add_material(const MaterialUse& own, std::string name, const std::string& public_name);

  Timeline<Recipe> recipes_of(const Definition& definition) const;
  template <class T>
  void add_ingredients(std::vector<Ingredient<Texture<T>>>& list, const ParamList& params, FileFrame frame) const;
  void add_ingredients(std::vector<Ingredient<Material>>& list, const ParamList& params, FileFrame frame) const;
  /// Returns whether a state, once made, is held as long as the world exists.
  bool is_kept(const std::vector<int>& state_of, int state) const;
  /// Makes every state by `make(recipe, textures)` to find errors, and holds those for which is_kept().
  template <class T, class Make>
  bool look_at(Look<T>& look, Make&& make);

  TextureSet known_textures(const Recipe& recipe) const;
  TextureSet made_textures(const Recipe& recipe, Diagnostics& diagnostics) const;
  MaterialSet made_materials(const Recipe& recipe, Diagnostics& diagnostics) const;
  template <class T>
  std::shared_ptr<const T> made(const Ingredient<T>& ingredient, Diagnostics& diagnostics) const;
  template <class T>
  TexturePtr<T> make_texture_of(const Recipe& recipe, const TextureSet& textures, Diagnostics& diagnostics) const;
  std::shared_ptr<const FloatTexture> make_of(const Recipe& recipe, const FloatTexture*, Diagnostics&) const;
  std::shared_ptr<const RgbTexture> make_of(const Recipe& recipe, const RgbTexture*, Diagnostics&) const;
  std::shared_ptr<const Material> make_of(const Recipe& recipe, const Material*, Diagnostics&) const;
  std::shared_ptr<const Material> make_material(const Recipe& recipe, const TextureSet& textures,
                                                Diagnostics& diagnostics) const;

  const SceneDescription& description_;
  Diagnostics& diagnostics_;  // while the world is being made
  std::shared_ptr<ImageCache> images_;
  TextureSet names_;  // of all textures so far, with something grey for each
  std::tuple<Textures<float>, Textures<Rgb>> textures_;
  std::deque<Look<FloatTexture>> numbers_;        // of parameters
  std::map<std::pair<int, int>, int> opacities_;  // by material and number of the shape
  std::deque<MaterialLook> materials_;            // addresses are stable
  DistinctNames material_names_;
  std::deque<TextureUse> texture_uses_;  // of geometry files
  std::deque<MaterialUse> material_uses_;
  std::vector<int> of_use_;                  // by index into SceneDescription::materials
  std::map<std::string, std::size_t> uses_;  // likewise, by name
  std::map<std::string, int> by_name_, by_name_in_files_;
  std::map<std::pair<std::filesystem::path, std::string>, int> from_files_;
  int default_ = -1;
};

}  // namespace dspm
