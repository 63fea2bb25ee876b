// From directives to the SceneDescription: keeps the state that is in force, and says what stands in the wrong place.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lang/blocks.h"
#include "lang/description.h"
#include "lang/directive.h"
#include "lang/graphics_state.h"
#include "lang/keyframe_group.h"

namespace dspm {

class SceneBuilder {
 public:
  SceneBuilder(SceneDescription& scene, Diagnostics& diagnostics)
      : scene_(scene), diagnostics_(diagnostics), blocks_(diagnostics) {}

  /// Everything but Include and Import, which the reader carries out; may throw SyntaxError.
  void apply(Directive directive);
  /// What an imported file does to the state ends with it.
  void begin_import(const Directive& directive);
  void end_import();
  /// To be called behind the last file.
  void finish();

  /// Inside VariationBegin .. VariationEnd, which are not read yet.
  bool is_skipping() const { return skipped_depth_ > 0; }

 private:
  using Places = std::map<std::string, SourceLocation>;

  bool skip_variations(const Directive& directive);
  void close_forgotten_group(const Directive& directive);
  bool check_section(const Directive& directive);
  void check_keys(const Directive& directive);
  void check_frame(int key, const SourceLocation& where);

  // Each carries the directive out if it is one of its own (build_options.cpp, build_transforms.cpp, build_world.cpp).
  bool apply_option(Directive& directive);
  bool apply_transform(const Directive& directive);
  bool apply_block(const Directive& directive);
  bool apply_look(Directive& directive);
  bool apply_thing(Directive& directive);

  void camera(Directive& directive);
  void frames(const Directive& directive);
  void option(const Directive& directive);
  void color_space(const Directive& directive);
  void world_begin(const SourceLocation& where);
  void set_plugin(std::optional<PluginUse>& slot, Directive& directive);
  void warn_of_second(const Directive& directive, const PluginUse* first);

  void multiply(const Directive& directive, const TransformOp& op);
  void replace(const Directive& directive, const TransformOp& op);
  bool is_usable(const Directive& directive, const Matrix4& matrix);
  bool is_blurred(const Directive& directive);
  void active_transform(const Directive& directive);
  void coordinate_system(const Directive& directive);
  void keyframe(const Directive& directive);
  void keyframe_end(const Directive& directive);
  void finish_group();

  void open_block(Block::Kind kind, const Directive& directive, std::string name);
  void close_block(Block::Kind kind, const Directive& directive);
  void dynamic_begin(const Directive& directive);
  void object_begin(const Directive& directive);
  void attribute(Directive& directive);
  void material(Directive& directive);
  void make_named_material(Directive& directive);
  void make_named_medium(Directive& directive);
  void medium_interface(const Directive& directive);
  void texture(Directive& directive);
  void area_light_source(Directive& directive);
  void light_source(Directive& directive);
  void shape(Directive& directive);
  void object_instance(const Directive& directive);

  /// The type is the directive's last word.
  static PluginUse plugin_use(Directive& directive);
  PluginUse plugin_use(Directive& directive, AttributeTarget target) const;
  /// The type is what "string type" says; nothing, after an error, where that lacks.
  std::optional<PluginUse> named_plugin_use(Directive& directive, AttributeTarget target);
  void define(Places& names, const Directive& directive);
  std::string take_light_name(ParamList& params);

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  GraphicsState state_;
  BlockStack blocks_;
  std::optional<SourceLocation> world_where_;  // of WorldBegin
  std::optional<KeyframeGroup> group_;         // the keys that are being read
  bool options_have_keys_ = false;
  bool blur_told_ = false;  // since the last ActiveTransform
  int skipped_depth_ = 0;
  std::vector<std::pair<int, SourceLocation>> keys_before_world_;        // checked when the number of frames is known
  std::vector<std::map<std::string, Motion>> outer_coordinate_systems_;  // of files that are being imported
  Places materials_, float_textures_, spectrum_textures_, media_, objects_;
};

}  // namespace dspm
