// Builds the SceneDescription from directives: keeps the current state, and reports misplaced directives.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/blocks.h"
#include "dspm/lang/description.h"
#include "dspm/lang/directive.h"
#include "dspm/lang/graphics_state.h"
#include "dspm/lang/keyframe_group.h"

namespace dspm {

class SceneBuilder {
 public:
  SceneBuilder(SceneDescription& scene, Diagnostics& diagnostics)
      : scene_(scene), diagnostics_(diagnostics), blocks_(diagnostics) {}

  /// Applies any directive but Include and Import, which the reader handles; may throw SyntaxError.
  void apply(Directive directive);
  /// Returns the shape that the last directive has made, if directives that repeat it except for numbers may become its
  /// run; otherwise null. Holds until the next call.
  ShapeUse* repeatable() { return repeatable_ != nullptr ? &repeatable_->back() : nullptr; }
  /// Begins an imported file, whose changes to the state end with it.
  void begin_import(const Directive& directive);
  void end_import();
  bool world_has_begun() const { return world_where_.has_value(); }
  /// Ends an included or a main file. After a whole scene, the job's directives may be replaced.
  void end_file(const SourceFile& file);
  /// Call it after the last file.
  void finish();

 private:
  using Places = std::map<std::string, SourceLocation>;

  /// The place where a Dynamic block begins.
  struct DynamicPlace {
    DynamicPlace(int index, const GraphicsState& outer) : block(index), state(outer) {}
    int block;  // into SceneDescription::dynamic_blocks
    GraphicsState state;
    bool is_alone = true;  // of its name
  };

  void close_forgotten_group(const Directive& directive);
  bool check_section(const Directive& directive);
  void check_keys(const Directive& directive);
  void check_key(Moment key, const SourceLocation& where);

  // Each applies the directive if it is one of its own (build_variations.cpp, build_options.cpp, ...).
  bool apply_variation(Directive& directive);
  bool apply_option(Directive& directive);
  bool apply_transform(const Directive& directive);
  bool apply_block(const Directive& directive);
  bool apply_look(Directive& directive);
  bool apply_thing(Directive& directive);

  void camera(Directive& directive);
  Motion place_of_replacing_camera() const;
  void frames(const Directive& directive);
  void option(const Directive& directive);
  void color_space(const Directive& directive);
  void world_begin(const SourceLocation& where);
  void set_plugin(std::optional<PluginUse>& slot, Directive& directive);
  bool may_replace(const Directive& directive) const;
  void warn_of_second(const Directive& directive, const PluginUse* first);
  void expect_still(const Directive& directive);

  void multiply(const Directive& directive, const TransformOp& op);
  TransformOp view_op(const Directive& directive);
  void find_named_places();
  void replace(const Directive& directive, const TransformOp& op);
  bool is_usable(const Directive& directive, const Matrix4& matrix);
  void transform_times(const Directive& directive);
  Motion ctm() const { return state_.ctm.motion(transform_times_); }
  void active_transform(const Directive& directive);
  void coordinate_system(const Directive& directive);
  bool may_begin_keys() const;
  void keyframe(const Directive& directive);
  void keyframe_end(const Directive& directive);
  void finish_group(After after = After::hold);

  bool is_out_of_place(const Directive& directive);
  void expect_top_level(const Directive& directive);
  void axis_begin(const Directive& directive);
  void axis_end(const Directive& directive);
  void variation_begin(const Directive& directive);
  void variation_end(const Directive& directive);
  void in_variation(const Directive& directive);
  void add_rule(const Directive& directive);
  void check_rules();
  bool find_axis(CombinationRule::Pattern& pattern);
  void check_pattern(const CombinationRule::Pattern& pattern);
  bool replace_lights(Directive& directive, Variation& variation);
  void replace_block(const Directive& directive);
  bool replace_job(Directive& directive, Variation& variation);
  void scale_light(const Directive& directive, Variation& variation);
  /// Returns the variation that is being read; null outside.
  Variation* variation_in_force();
  void check_replacements();

  void open_block(Block::Kind kind, const Directive& directive, std::string name);
  void close_block(Block::Kind kind, const Directive& directive);
  void dynamic_begin(const Directive& directive);
  /// Opens a Dynamic block. `place` is that of the scene's block whose contents are replaced, or null.
  void open_dynamic(const Directive& directive, const DynamicPlace* place);
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

  /// Takes the type from the directive's last word.
  static PluginUse plugin_use(Directive& directive);
  PluginUse plugin_use(Directive& directive, AttributeTarget target) const;
  /// Takes the type from "string type"; returns nullopt, after an error, if that is missing.
  std::optional<PluginUse> named_plugin_use(Directive& directive, AttributeTarget target);
  void define(Places& names, const Directive& directive);
  std::string take_name(ParamList& params);

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  GraphicsState state_;
  BlockStack blocks_;
  std::optional<SourceLocation> world_where_;    // of WorldBegin
  std::optional<KeyframeGroup> group_;           // the keys being read
  std::vector<ShapeUse>* repeatable_ = nullptr;  // the list that it ends
  bool scene_is_whole_ = false;                  // the file with WorldBegin has ended
  bool options_have_keys_ = false;
  TransformTimes transform_times_;
  std::vector<std::pair<Moment, SourceLocation>> keys_before_world_;     // checked when the number of frames is known
  std::vector<std::map<std::string, Motion>> outer_coordinate_systems_;  // of files being imported
  Places float_textures_, spectrum_textures_, materials_, media_, objects_, axes_;
  struct {
    Places float_textures, spectrum_textures, materials, media, lights, switches, light_sources, area_lights, blocks;
  } replaced_;                                                       // by the current variation
  std::vector<Places> variations_;                                   // by axis
  std::map<std::string, DynamicPlace> dynamic_states_;               // by name, the first of each
  std::map<std::string, std::shared_ptr<NamedPlace>> named_places_;  // of LookAts
  std::map<std::string, std::vector<Motion>> ends_of_blocks_;        // the transforms with which Dynamic blocks end
  Motion around_variation_;                                          // the current transform when it began
  std::size_t axis_of_variation_ = 0;
};

}  // namespace dspm
