#include "dspm/lang/scene_builder.h"

#include <fmt/format.h>

namespace dspm {
namespace {

using enum DirectiveKind;

std::string frames_in_words(const SceneDescription& scene) {
  const int first = scene.first_moment.number(), last = first + scene.moments - 1;
  if (first != 1) return first == last ? fmt::format("frame {}", first) : fmt::format("frames {} to {}", first, last);
  return fmt::format("{} frame{}", last, last == 1 ? "" : "s");
}

bool takes_keys(DirectiveKind kind) {
  switch (kind) {
    case camera:
    case material:
    case make_named_material:
    case make_named_medium:
    case texture:
    case light_source:
    case area_light_source:
    case light:
    case shape:
    case attribute: return true;
    default: return false;
  }
}

}  // namespace

void SceneBuilder::apply(Directive directive) {
  repeatable_ = nullptr;
  if (group_ && !moves(directive.info->kind)) close_forgotten_group(directive);
  if (!check_section(directive)) return;
  check_keys(directive);
  directive.params.space = state_.space;
  for (Param& param : directive.params.params) param.space = state_.space;
  apply_variation(directive) || apply_option(directive) || apply_transform(directive) || apply_block(directive) ||
      apply_look(directive) || apply_thing(directive);
}

void SceneBuilder::close_forgotten_group(const Directive& directive) {
  diagnostics_.error(directive.where,
                     fmt::format("only transforms are allowed between keys, not {}", directive.info->name),
                     fmt::format("KeyframeEnd is missing: the keys began on line {}", group_->where().line));
  finish_group();
}

bool SceneBuilder::check_section(const Directive& directive) {
  if (directive.info->section == Section::options && world_where_ && !may_replace(directive)) {
    diagnostics_.error(directive.where, fmt::format("{} must come before WorldBegin", directive.info->name),
                       fmt::format("the world begins on {}", place_of(*world_where_, directive.where)));
    return false;
  }
  if (directive.info->section == Section::world && !world_where_) {
    diagnostics_.error(directive.where, fmt::format("{} must come after WorldBegin", directive.info->name),
                       "WorldBegin is missing before it, unless this file is meant to be included by another");
    world_begin(directive.where);  // one such error is enough
  }
  return true;
}

void SceneBuilder::check_keys(const Directive& directive) {
  for (const Param& param : directive.params.params) {
    if (!param.key) continue;
    if (takes_keys(directive.info->kind))
      check_key(*param.key, param.where);
    else
      diagnostics_.error(param.where,
                         fmt::format("parameters of {} cannot change between frames", directive.info->name),
                         "those of Camera, materials, media, textures, lights and shapes in Dynamic blocks can");
  }
}

void SceneBuilder::check_key(Moment key, const SourceLocation& where) {
  if (!world_where_)
    keys_before_world_.emplace_back(key, where);
  else if (const auto all = scene_.all_moments();  // beside them shutters are open
           !(key.frames() > all.first.frames() - 1 && key <= all.end))
    diagnostics_.warning(where, fmt::format("this key for frame {} is out of range: the scene has {}", number_of(key),
                                            frames_in_words(scene_)));
}

void SceneBuilder::world_begin(const SourceLocation& where) {
  if (world_where_) {
    diagnostics_.error(where, "a second WorldBegin", fmt::format("the first is on {}", place_of(*world_where_, where)));
    return;
  }
  world_where_ = where;
  state_.ctm = {};
  scene_.coordinate_systems["world"] = {};
  scene_.coordinate_systems.try_emplace("camera");  // a scene without Camera has one at the origin
  for (const auto& [key, place] : keys_before_world_) check_key(key, place);
}

void SceneBuilder::begin_import(const Directive& directive) {
  if (group_) close_forgotten_group(directive);
  check_section(directive);
  is_out_of_place(directive);
  open_block(Block::Kind::import, directive, directive.words[0].text);
  outer_coordinate_systems_.push_back(scene_.coordinate_systems);
}

void SceneBuilder::end_import() {
  if (group_) {
    diagnostics_.error(group_->where(), "these keys are not closed", "KeyframeEnd is missing");
    finish_group();
  }
  state_ = blocks_.close_import();
  scene_.coordinate_systems = std::move(outer_coordinate_systems_.back());
  outer_coordinate_systems_.pop_back();
}

/// Ends a file. A file that includes a scene replaces what it says of the job. Transforms for its Camera start in the
/// world.
void SceneBuilder::end_file(const SourceFile& file) {
  if (!world_where_ || world_where_->file != &file) return;
  scene_is_whole_ = true;
  options_have_keys_ = false;
  if (scene_.dialect == Dialect::dsc && blocks_.empty() && !group_) state_.ctm = {};
}

bool SceneBuilder::may_replace(const Directive& directive) const {
  const bool in_variation = blocks_.innermost_is(Block::Kind::variation);
  switch (directive.info->kind) {
    case DirectiveKind::camera:
    case integrator: return in_variation || (scene_is_whole_ && blocks_.empty());
    case film:
    case sampler:
    case pixel_filter:
    case accelerator: return scene_is_whole_ && blocks_.empty();
    default: return false;
  }
}

void SceneBuilder::finish() {
  if (group_) diagnostics_.error(group_->where(), "these keys are not closed", "KeyframeEnd is missing");
  blocks_.check_all_closed();
  check_replacements();
  check_rules();
  find_named_places();
  if (!world_where_ && diagnostics_.error_count() == 0)
    diagnostics_.error({scene_.files.front().get()}, "there is no WorldBegin, so there is nothing to render");
}

}  // namespace dspm
