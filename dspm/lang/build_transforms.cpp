// The current transform: its changes, its keys, and the coordinate systems that name it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/lang/scene_builder.h"
#include "dspm/math/frames.h"
#include "dspm/math/vanishing.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

using enum DirectiveKind;

TransformOp op_of(TransformOp::Kind kind, const Directive& directive) {
  TransformOp op{kind, {}};
  std::copy(directive.numbers.begin(), directive.numbers.end(), op.arguments.begin());
  return op;
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
    case look_at: multiply(directive, op_of(TransformOp::Kind::look_at, directive)); return true;
    case concat_transform: multiply(directive, op_of(TransformOp::Kind::matrix, directive)); return true;
    case transform: replace(directive, op_of(TransformOp::Kind::matrix, directive)); return true;
    case identity: replace(directive, matrix_op({})); return true;
    case DirectiveKind::active_transform: active_transform(directive); return true;
    case DirectiveKind::coordinate_system: scene_.coordinate_systems[directive.words[0].text] = state_.ctm; return true;
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
  return !is_blurred(directive);
}

void SceneBuilder::multiply(const Directive& directive, const TransformOp& op) {
  const Matrix4 matrix = op.matrix();
  if (!is_usable(directive, matrix)) return;
  if (group_) return group_->multiply(op);
  Motion motion = state_.ctm;
  motion.multiply(matrix);
  if (const Matrix4 at_first = motion.at(Moment()); is_regular(at_first) || (motion.is_keyed() && vanishes(at_first)))
    state_.ctm = std::move(motion);
  else
    diagnostics_.error(directive.where,
                       fmt::format("this {} makes the current transform singular", directive.info->name));
}

void SceneBuilder::replace(const Directive& directive, const TransformOp& op) {
  const Matrix4 matrix = op.matrix();
  if (!is_usable(directive, matrix)) return;
  if (group_) return group_->replace(op);
  state_.ctm = Motion(matrix);
}

bool SceneBuilder::is_blurred(const Directive& directive) {
  if (state_.active == GraphicsState::Active::both) return false;
  if (!blur_told_)
    diagnostics_.unsupported(directive.where,
                             "motion blur (a transform for one end of the shutter interval) is not "
                             "supported yet",
                             "with --lenient, everything stays where it is when the shutter opens");
  blur_told_ = true;
  return state_.active == GraphicsState::Active::end;  // --lenient renders the state at the start
}

void SceneBuilder::active_transform(const Directive& directive) {
  const std::string& word = directive.words[0].text;
  if (word != "All" && word != "StartTime" && word != "EndTime")
    diagnostics_.error(directive.words[0].where, "expected All, StartTime or EndTime");
  state_.active = word == "StartTime" ? GraphicsState::Active::start
                  : word == "EndTime" ? GraphicsState::Active::end
                                      : GraphicsState::Active::both;
  blur_told_ = false;
}

void SceneBuilder::coordinate_system(const Directive& directive) {
  const Argument& name = directive.words[0];
  const auto found = scene_.coordinate_systems.find(name.text);
  if (found == scene_.coordinate_systems.end()) {
    std::vector<std::string> known;
    for (const auto& [each, motion] : scene_.coordinate_systems) known.push_back(each);
    diagnostics_.error(name.where, fmt::format("unknown coordinate system \"{}\"", name.text),
                       did_you_mean(name.text, known));
  } else if (is_blurred(directive)) {
    return;
  } else if (!group_) {
    state_.ctm = found->second;
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
  const double key = directive.numbers[0];
  if (!(key >= 1 && key <= kMostFrames && key == std::floor(key))) {
    diagnostics_.error(directive.where, fmt::format("expected a frame from 1 to {}", kMostFrames));
  } else if (!group_ && !may_begin_keys()) {
    diagnostics_.error(directive.where, "Keyframe must be in a Dynamic block or before Camera");
  }
  if (!group_) {
    bool& has_keys = blocks_.empty() ? options_have_keys_ : blocks_.innermost().has_keys;
    if (has_keys)
      diagnostics_.error(directive.where, "a second group of keys in this block", "AttributeBegin opens another block");
    has_keys = true;
    group_.emplace(directive.where);
  }
  ParamReader reader(directive.params, "Keyframe", directive.where, diagnostics_);
  const std::string ease =
      reader.choice("ease", "linear", {"linear", "smooth", "step"}, "easing from this key to the next");
  reader.finish();
  const Moment moment = Moment::numbered(static_cast<int>(std::clamp(key, 1.0, static_cast<double>(kMostFrames))));
  check_key(moment, directive.where);
  group_->begin_key(moment,
                    ease == "smooth" ? Ease::smooth
                    : ease == "step" ? Ease::step
                                     : Ease::linear,
                    directive.where, diagnostics_);
}

void SceneBuilder::keyframe_end(const Directive& directive) {
  if (group_)
    finish_group();
  else
    diagnostics_.error(directive.where, "KeyframeEnd without Keyframe");
}

void SceneBuilder::finish_group() {
  state_.ctm = group_->finish(state_.ctm, diagnostics_);
  group_.reset();
}

}  // namespace dspm
