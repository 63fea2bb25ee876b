// Blocks after WorldBegin: attributes, Dynamic blocks, objects and their instances.
#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/scene_builder.h"

namespace dspm {

namespace {

using enum DirectiveKind;

}  // namespace

bool SceneBuilder::apply_block(const Directive& directive) {
  switch (directive.info->kind) {
    case attribute_begin: open_block(Block::Kind::attribute, directive, {}); return true;
    case attribute_end: close_block(Block::Kind::attribute, directive); return true;
    case transform_begin: open_block(Block::Kind::transform, directive, {}); return true;
    case transform_end: close_block(Block::Kind::transform, directive); return true;
    case DirectiveKind::dynamic_begin: dynamic_begin(directive); return true;
    case dynamic_end: close_block(Block::Kind::dynamic, directive); return true;
    case DirectiveKind::object_begin: object_begin(directive); return true;
    case object_end: close_block(Block::Kind::object, directive); return true;
    default: return false;
  }
}

void SceneBuilder::open_block(Block::Kind kind, const Directive& directive, std::string name) {
  blocks_.open({kind, std::move(name), directive.where, state_});
}

void SceneBuilder::close_block(Block::Kind kind, const Directive& directive) {
  if (kind == Block::Kind::dynamic && blocks_.innermost_is(kind) && variation_in_force() == nullptr)
    ends_of_blocks_[blocks_.innermost().name].push_back(ctm());
  state_ = blocks_.close(kind, directive.where, state_);
}

void SceneBuilder::dynamic_begin(const Directive& directive) {
  const std::string& name = directive.words[0].text;
  if (variation_in_force() != nullptr) return replace_block(directive);
  const auto [known, is_new] =
      dynamic_states_.try_emplace(name, static_cast<int>(scene_.dynamic_blocks.size()), state_);
  if (!is_new) known->second.is_alone = false;
  open_dynamic(directive, nullptr);
}

void SceneBuilder::open_dynamic(const Directive& directive, const DynamicPlace* place) {
  const std::string& name = directive.words[0].text;
  open_block(Block::Kind::dynamic, directive, name);
  MomentInterval moments = scene_.all_moments();
  if (place != nullptr) {
    state_ = place->state;
    moments = scene_.dynamic_blocks[static_cast<std::size_t>(place->block)].moments;
  }
  ParamReader reader(directive.params, "DynamicBegin", directive.where, diagnostics_);
  const std::vector<int> limits = reader.integers("frames", "the first and the last frame in which its shapes exist");
  state_.blurs = reader.flag(kBlurParam, state_.blurs, "false: it is sharp, however long the shutter is open");
  reader.finish();
  if (reader.has("frames")) {
    const int lowest = scene_.clock().lowest();
    if (limits.size() != 2 || limits[0] < lowest || limits[1] < limits[0])
      reader.error("frames", fmt::format("expected the first and the last frame, counted from {}", lowest));
    else {
      check_key(Moment::numbered(limits[1]), reader.where("frames"));
      moments = {std::clamp(Moment::numbered(limits[0]), moments.first, moments.end),
                 std::clamp(Moment(limits[1]), moments.first, moments.end)};
    }
  }
  if (state_.dynamic_block >= 0) {
    const MomentInterval outer = scene_.dynamic_blocks[static_cast<std::size_t>(state_.dynamic_block)].moments;
    moments.first = std::clamp(moments.first, outer.first, outer.end);
    moments.end = std::clamp(moments.end, moments.first, outer.end);
  }
  scene_.dynamic_blocks.push_back({name, moments, directive.where, state_.dynamic_block});
  state_.dynamic_block = static_cast<int>(scene_.dynamic_blocks.size()) - 1;
}

void SceneBuilder::object_begin(const Directive& directive) {
  if (const Block* outer = blocks_.find(Block::Kind::object))
    diagnostics_.error(directive.where,
                       fmt::format("ObjectBegin inside {} (line {})", begin_of(*outer), outer->where.line),
                       "objects cannot hold objects");
  open_block(Block::Kind::object, directive, directive.words[0].text);
  define(objects_, directive);
  scene_.objects.push_back({directive.words[0].text, {}, directive.where});
}

/// Reports an error if something moves outside of Dynamic blocks, which pbrt has not. After a whole scene, keys for its
/// Camera may stand there, and a light may follow them.
void SceneBuilder::expect_still(const Directive& directive) {
  if (scene_.dialect == Dialect::dsc && state_.dynamic_block < 0 && ctm().is_keyed())
    diagnostics_.error(directive.where,
                       fmt::format("this {} moves, but is not in a Dynamic block", directive.info->name),
                       "put it and its keys between DynamicBegin \"a name\" and DynamicEnd");
}

void SceneBuilder::object_instance(const Directive& directive) {
  expect_still(directive);
  if (const Block* outer = blocks_.find(Block::Kind::object))
    diagnostics_.error(directive.where,
                       fmt::format("ObjectInstance inside {} (line {})", begin_of(*outer), outer->where.line),
                       "objects cannot hold objects");
  scene_.instances.push_back({directive.words[0].text, ctm(), state_.reverse_orientation, state_.dynamic_block,
                              directive.words[0].where, state_.blurs});
}

}  // namespace dspm
