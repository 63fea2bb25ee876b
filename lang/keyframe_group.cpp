#include "dspm/lang/keyframe_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vanishing.h"
#include "dspm/lang/clock.h"
#include "dspm/lang/pose.h"

namespace dspm {
namespace {

constexpr int kMostKeyed = 32;  // nested; each shape inside has a motion with that many factors
constexpr std::size_t kMostAimedKeys = 1000;

bool has_matrix(const std::vector<TransformOp>& ops) {
  return std::any_of(ops.begin(), ops.end(),
                     [](const TransformOp& op) { return op.kind == TransformOp::Kind::matrix; });
}

}  // namespace

bool fits_float(const Matrix4& matrix) {
  for (const auto& row : matrix.m)
    for (const double v : row)
      if (!(std::abs(v) <= std::numeric_limits<float>::max())) return false;
  return true;
}

bool is_regular(const Matrix4& matrix) { return fits_float(matrix) && matrix.inverse().has_value(); }

void KeyframeGroup::begin_key(KeyDirective key, Diagnostics& diagnostics) {
  if (!keys_.empty() && key.moment <= keys_.back().moment) {
    const Moment last = keys_.back().moment;
    diagnostics.error(key.where,
                      fmt::format("Keyframe {} comes after Keyframe {}", number_of(key.moment), number_of(last)),
                      "keys must be in ascending order");
    key.moment = Moment(last.frames() + 1);
  }
  keys_.push_back({std::move(key)});
}

void KeyframeGroup::multiply(const TransformOp& op) { keys_.back().ops.push_back(op); }

void KeyframeGroup::replace(const TransformOp& op) {
  keys_.back().ops = {op};
  keys_.back().replaces = true;
}

Motion KeyframeGroup::finish(const Motion& before, After after, const MomentInterval& moments,
                             Diagnostics& diagnostics) {
  const auto replaces = [](const Key& key) { return key.replaces; };
  const bool any_replaces = std::any_of(keys_.begin(), keys_.end(), replaces);
  if (any_replaces && !std::all_of(keys_.begin(), keys_.end(), replaces)) {
    if (before.is_keyed())
      diagnostics.error(where_, "some of these keys replace the transform before them, others do not",
                        "inside another keyed transform, all or none of them may use Transform or Identity");
    for (Key& key : keys_)
      if (!key.replaces) key.ops.insert(key.ops.begin(), matrix_op(before.at(Moment())));
  }
  const bool has_tangents = std::any_of(
      keys_.begin(), keys_.end(), [](const Key& key) { return !key.tangent_in.empty() || !key.tangent_out.empty(); });
  aim_all();
  KeyedTransform keyed(transform_keys(), after, has_tangents ? Ease::cubic : Ease::linear);
  const int errors = diagnostics.error_count();
  if (has_tangents) check_tangents(keyed, diagnostics);
  check_turns(keyed, diagnostics);
  if (keyed.is_aimed()) check_names(keyed, diagnostics);
  if (after != After::hold) check_cycle(keyed, diagnostics);
  Motion motion = any_replaces ? Motion() : before;
  if (diagnostics.error_count() > errors) return motion;
  if (!keyed.is_aimed()) check_regular(keyed, moments, diagnostics);  // else when all names are known
  if (motion.keyed_count() < kMostKeyed)
    motion.multiply(std::move(keyed));
  else
    diagnostics.error(where_, fmt::format("keyed transforms are nested more than {} deep", kMostKeyed));
  return motion;
}

/// If one LookAt names something, all of them place things.
void KeyframeGroup::aim_all() {
  const auto is_aimed = [](const TransformOp& op) { return op.is_aimed(); };
  if (std::none_of(keys_.begin(), keys_.end(),
                   [&](const Key& key) { return std::any_of(key.ops.begin(), key.ops.end(), is_aimed); }))
    return;
  for (Key& key : keys_)
    for (TransformOp& op : key.ops) op.places_things = op.kind == TransformOp::Kind::look_at;
}

std::vector<TransformKey> KeyframeGroup::transform_keys() const {
  std::vector<TransformKey> keys;
  for (const Key& key : keys_)
    keys.push_back({key.moment, key.ease, key.ops, key.turns, key.tangent_in, key.tangent_out});
  return keys;
}

void KeyframeGroup::check_tangents(const KeyedTransform& keyed, Diagnostics& diagnostics) const {
  const bool has_arguments = keyed.goes_by_arguments() &&
                             std::none_of(keys_.begin(), keys_.end(), [](const Key& k) { return has_matrix(k.ops); });
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const Key& key = keys_[i];
    if (key.tangent_in.empty() && key.tangent_out.empty()) continue;
    std::size_t count = 0;
    for (const TransformOp& op : key.ops) count += argument_count(op.kind);
    const auto fits = [&](const std::vector<double>& tangent) { return tangent.empty() || tangent.size() == count; };
    const bool arrives = i > 0 && keyed.ease(i - 1) == Ease::cubic,
               leaves = i + 1 < keys_.size() && keyed.ease(i) == Ease::cubic;
    if (!has_arguments)
      diagnostics.error(key.tangent_where, "tangents need keys with the same transforms, and no matrices",
                        "write the same sequence of Translate, Rotate, Scale and LookAt at each key");
    else if (!fits(key.tangent_in) || !fits(key.tangent_out))
      diagnostics.error(key.tangent_where,
                        fmt::format("the tangent has {} numbers, but the transforms of this key have {}",
                                    fits(key.tangent_in) ? key.tangent_out.size() : key.tangent_in.size(), count),
                        "it says for each of their numbers how it changes per frame, in their order");
    else if (!(arrives && !key.tangent_in.empty()) && !(leaves && !key.tangent_out.empty()))
      diagnostics.error(key.tangent_where, "this tangent has no effect: no cubic way begins or ends here",
                        "the key that the way begins with must be left by \"string ease\" \"cubic\"");
  }
}

/// Turns need an axis: between two matrices, that of the rotation from one to the other.
void KeyframeGroup::check_turns(const KeyedTransform& keyed, Diagnostics& diagnostics) const {
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (keys_[i].turns == 0) continue;
    const SourceLocation& where = keys_[i].turns_where;
    if (i + 1 == keys_.size() || keyed.ease(i) == Ease::step) {
      diagnostics.error(where, "these turns have no effect: nothing moves after this key");
      continue;
    }
    const std::vector<TransformOp>&from = keys_[i].ops, &to = keys_[i + 1].ops;
    const bool by_arguments = keyed.ease(i) == Ease::cubic ? keyed.goes_by_arguments() : same_sequence(from, to);
    if (by_arguments && !has_matrix(from)) {
      diagnostics.error(where, "turns are for matrices, and for keys whose transforms differ",
                        "the angle of Rotate says how often it turns: Rotate 720 0 1 0 is two full turns");
      continue;
    }
    const auto turns = [](const Matrix4& a, const Matrix4& b) {
      return axis_between(decompose(a).rotation, decompose(b).rotation) != std::array<double, 3>{};
    };
    bool any = !by_arguments && turns(KeyedTransform({{Moment(), Ease::linear, from}}).at(Moment()),
                                      KeyedTransform({{Moment(), Ease::linear, to}}).at(Moment()));
    for (std::size_t op = 0; by_arguments && op < from.size(); ++op)
      any = any || (from[op].kind == TransformOp::Kind::matrix && turns(from[op].matrix(), to[op].matrix()));
    if (!any)
      diagnostics.error(where, "the rotation is the same at this key and the next, so there is no axis for turns",
                        "write it as Rotate: Rotate 720 0 1 0 is two full turns");
  }
}

void KeyframeGroup::check_names(const KeyedTransform& keyed, Diagnostics& diagnostics) const {
  if (!keyed.goes_by_arguments())
    diagnostics.error(where_, "keys with a LookAt at a name need the same sequence of transforms at each key");
  if (keys_.size() > kMostAimedKeys)
    diagnostics.error(where_, fmt::format("more than {} keys with a LookAt at a name", kMostAimedKeys));
}

void KeyframeGroup::check_cycle(const KeyedTransform& keyed, Diagnostics& diagnostics) const {
  if (keys_.size() < 2)
    diagnostics.error(where_, "one key makes no cycle", "the way from the first key to the last is repeated");
  else if (keyed.after() == After::offset && vanishes(keyed.at(keys_.front().moment)))
    diagnostics.error(where_, "what a scale of 0 hides at its first key cannot go on from there", "\"repeat\" can");
}

void KeyframeGroup::check_regular(const KeyedTransform& keyed, const MomentInterval& moments,
                                  Diagnostics& diagnostics) const {
  const double first = std::max(std::floor(keys_.front().moment.frames()), moments.first.frames()),
               end = keyed.after() == After::hold
                         ? std::min(std::ceil(keys_.back().moment.frames()) + 1, moments.end.frames())
                         : moments.end.frames();
  for (double frame = first; frame < end; ++frame) {
    const Moment moment(frame);
    const Matrix4 matrix = keyed.at(moment);
    if (is_regular(matrix) || vanishes(matrix)) continue;
    diagnostics.error(where_, fmt::format("the transform between these keys is singular at frame {}", moment.number()));
    return;
  }
}

}  // namespace dspm
