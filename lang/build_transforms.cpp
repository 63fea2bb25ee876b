// The current transform: its changes, its keys, and the coordinate systems that name it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vanishing.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/scene_builder.h"

namespace dspm {
namespace {

using enum DirectiveKind;

TransformOp op_of(TransformOp::Kind kind, const Directive& directive) {
  TransformOp op{kind, {}};
  std::copy(directive.numbers.begin(), directive.numbers.end(), op.arguments.begin());
  return op;
}

KeyDirective key_of(ParamReader& reader) {
  KeyDirective key{{}, reader.where()};
  const std::string ease =
      reader.choice("ease", "linear", {"linear", "smooth", "step", "cubic"}, "easing from this key to the next");
  if (reader.has("ease"))
    key.ease = ease == "smooth"  ? Ease::smooth
               : ease == "step"  ? Ease::step
               : ease == "cubic" ? Ease::cubic
                                 : Ease::linear;
  key.turns = reader.integer("turns", 0, "", "full turns more on the way to the next key");
  key.turns_where = reader.where("turns");
  const auto tangent = [&](const char* name, const char* sentence) {
    const std::vector<float> numbers = reader.numbers(name, sentence);
    if (reader.has(name)) key.tangent_where = reader.where(name);
    return std::vector<double>(numbers.begin(), numbers.end());
  };
  const std::vector<double> both = tangent("tangent", "how the numbers of the transforms change per frame here");
  key.tangent_in = tangent("tangentin", "the same before this key");
  key.tangent_out = tangent("tangentout", "the same after this key");
  if (key.tangent_in.empty()) key.tangent_in = both;
  if (key.tangent_out.empty()) key.tangent_out = both;
  reader.finish();
  return key;
}

std::string_view reason_singular(const Directive& directive) {
  switch (directive.info->kind) {
    case DirectiveKind::scale: return "none of its factors may be 0";
    case rotate: return "its axis must not be 0 0 0";
    case look_at: return "eye and target must differ, and up must not be parallel to the view direction";
    default: return "it must have an inverse";
  }
}

}  // namespace

bool SceneBuilder::apply_transform(const Directive& directive) {
  switch (directive.info->kind) {
    case translate: multiply(directive, op_of(TransformOp::Kind::translate, directive)); return true;
    case rotate: multiply(directive, op_of(TransformOp::Kind::rotate, directive)); return true;
    case DirectiveKind::scale: multiply(directive, op_of(TransformOp::Kind::scale, directive)); return true;
    case look_at: multiply(directive, view_op(directive)); return true;
    case concat_transform: multiply(directive, op_of(TransformOp::Kind::matrix, directive)); return true;
    case transform: replace(directive, op_of(TransformOp::Kind::matrix, directive)); return true;
    case identity: replace(directive, matrix_op({})); return true;
    case DirectiveKind::active_transform: active_transform(directive); return true;
    case DirectiveKind::coordinate_system: scene_.coordinate_systems[directive.words[0].text] = ctm(); return true;
    case coord_sys_transform: coordinate_system(directive); return true;
    case DirectiveKind::keyframe: keyframe(directive); return true;
    case DirectiveKind::keyframe_end: keyframe_end(directive); return true;
    default: return false;
  }
}

bool SceneBuilder::is_usable(const Directive& directive, const Matrix4& matrix) {
  if (!fits_float(matrix)) {
    diagnostics_.error(directive.where, fmt::format("{} has a number that is too large", directive.info->name));
    return false;
  }
  const bool hides = group_ && vanishes(matrix);
  if (!is_regular(matrix) && !hides) {
    diagnostics_.error(directive.where, fmt::format("{} is singular", directive.info->name),
                       std::string(reason_singular(directive)));
    return false;
  }
  if (!matrix.is_affine()) {
    diagnostics_.error(directive.where, fmt::format("{} is not affine", directive.info->name),
                       "values 4, 8 and 12 must be 0, value 16 must be 1");
    return false;
  }
  return true;
}

void SceneBuilder::multiply(const Directive& directive, const TransformOp& op) {
  const Matrix4 matrix = op.matrix();
  if (!is_usable(directive, matrix)) return;
  if (group_) return group_->multiply(op);
  if (op.is_aimed()) {
    KeyframeGroup alone(directive.where);
    alone.begin_key({scene_.first_moment, directive.where}, diagnostics_);
    alone.multiply(op);
    state_.ctm = CurrentTransform(alone.finish(ctm(), After::hold, {}, diagnostics_));
    return;
  }
  bool is_singular = false;
  state_.ctm.change([&](Motion& current) {
    Motion motion = current;
    motion.multiply(matrix);
    const Matrix4 at_first = motion.at(Moment());
    if (is_regular(at_first) || (motion.is_keyed() && vanishes(at_first)))
      current = std::move(motion);
    else
      is_singular = true;
  });
  if (is_singular)
    diagnostics_.error(directive.where,
                       fmt::format("this {} makes the current transform singular", directive.info->name));
}

TransformOp SceneBuilder::view_op(const Directive& directive) {
  TransformOp op = op_of(TransformOp::Kind::look_at, directive);
  for (std::size_t i = 0; i < op.places.size() && i < directive.words.size(); ++i) {
    const Argument& name = directive.words[i];
    if (name.text.empty()) continue;
    std::shared_ptr<NamedPlace>& place = named_places_[name.text];
    if (!place) place = std::make_shared<NamedPlace>(NamedPlace{name.text, name.where});
    op.places[i] = place;
  }
  op.places_things = op.is_aimed();
  return op;
}

void SceneBuilder::replace(const Directive& directive, const TransformOp& op) {
  const Matrix4 matrix = op.matrix();
  if (!is_usable(directive, matrix)) return;
  if (group_) return group_->replace(op);
  state_.ctm.set(Motion(matrix));
}

void SceneBuilder::active_transform(const Directive& directive) {
  const std::string& word = directive.words[0].text;
  if (word != "All" && word != "StartTime" && word != "EndTime")
    diagnostics_.error(directive.words[0].where, "expected All, StartTime or EndTime");
  using Active = CurrentTransform::Active;
  state_.ctm.activate(word == "StartTime" ? Active::start : word == "EndTime" ? Active::end : Active::both);
}

void SceneBuilder::coordinate_system(const Directive& directive) {
  const Argument& name = directive.words[0];
  const auto found = scene_.coordinate_systems.find(name.text);
  if (found == scene_.coordinate_systems.end()) {
    std::vector<std::string> known;
    for (const auto& [each, motion] : scene_.coordinate_systems) known.push_back(each);
    diagnostics_.error(name.where, fmt::format("unknown coordinate system \"{}\"", name.text),
                       did_you_mean(name.text, known));
  } else if (!group_) {
    state_.ctm.set(found->second);
  } else if (found->second.is_keyed()) {
    diagnostics_.error(name.where, fmt::format("the coordinate system \"{}\" moves, so it cannot be a key", name.text));
  } else {
    group_->replace(matrix_op(found->second.at(Moment())));
  }
}

bool SceneBuilder::may_begin_keys() const {
  if (!world_where_) return !scene_.camera;
  return state_.dynamic_block >= 0 || blocks_.innermost_is(Block::Kind::variation) ||
         (scene_is_whole_ && blocks_.empty());
}

void SceneBuilder::keyframe(const Directive& directive) {
  if (!group_ && !may_begin_keys()) {
    diagnostics_.error(directive.where, "Keyframe must be in a Dynamic block or before Camera");
  }
  if (!group_) {
    bool& has_keys = blocks_.empty() ? options_have_keys_ : blocks_.innermost().has_keys;
    if (has_keys)
      diagnostics_.error(directive.where, "a second group of keys in this block", "AttributeBegin opens another block");
    has_keys = true;
    group_.emplace(directive.where);
  }
  const Moment moment(directive.numbers[0] - 1);
  check_key(moment, directive.where);
  ParamReader reader(directive.params, "Keyframe", directive.where, diagnostics_);
  KeyDirective key = key_of(reader);
  key.moment = moment;
  group_->begin_key(std::move(key), diagnostics_);
}

void SceneBuilder::keyframe_end(const Directive& directive) {
  ParamReader reader(directive.params, "KeyframeEnd", directive.where, diagnostics_);
  const std::string after = reader.choice("after", "hold", {"hold", "repeat", "offset"}, "what follows the last key");
  reader.finish();
  if (group_)
    finish_group(after == "repeat" ? After::repeat : after == "offset" ? After::offset : After::hold);
  else
    diagnostics_.error(directive.where, "KeyframeEnd without Keyframe");
}

void SceneBuilder::finish_group(After after) {
  const bool frames_are_known = world_where_ || scene_.frames_where.file != nullptr;
  const MomentInterval all{scene_.first_moment, Moment(scene_.first_moment.frames() + kMostFrames)};
  state_.ctm =
      CurrentTransform(group_->finish(ctm(), after, frames_are_known ? scene_.all_moments() : all, diagnostics_));
  group_.reset();
}

}  // namespace dspm
