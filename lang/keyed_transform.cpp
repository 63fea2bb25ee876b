#include "dspm/lang/keyed_transform.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "dspm/base/math/vanishing.h"
#include "dspm/lang/motion.h"
#include "dspm/lang/pose.h"

namespace dspm {
namespace {

using OpKind = TransformOp::Kind;
using Ops = std::vector<TransformOp>;

Matrix4 product(const Ops& ops) {
  Matrix4 r;
  for (const TransformOp& op : ops) r = r * op.matrix();
  return r;
}

double eased(double t, Ease ease) { return ease == Ease::smooth ? t * t * (3 - 2 * t) : t; }

/// What of a directive's arguments is one thing: a point, an angle, an axis.
std::span<const Quantity> quantities(OpKind kind) {
  static constexpr Quantity kVector[] = {{0, 3}}, kTurn[] = {{0, 1}, {1, 3}}, kView[] = {{0, 3}, {3, 3}, {6, 3}},
                            kPose[] = {{0, 3}, {3, 4}, {7, 9}};
  switch (kind) {
    case OpKind::rotate: return kTurn;
    case OpKind::look_at: return kView;
    case OpKind::matrix: return kPose;
    default: return kVector;
  }
}

Numbers numbers_of(const Pose& pose) {
  Numbers numbers;
  auto next = std::copy(pose.translation.begin(), pose.translation.end(), numbers.begin());
  next = std::copy(pose.rotation.begin(), pose.rotation.end(), next);
  for (const auto& row : pose.stretch) next = std::copy(row.begin(), row.end(), next);
  return numbers;
}

Quaternion rotation_in(const Numbers& n) { return {n[3], n[4], n[5], n[6]}; }

Pose pose_of(const Numbers& n) {
  return {{n[0], n[1], n[2]}, rotation_in(n), {{{n[7], n[8], n[9]}, {n[10], n[11], n[12]}, {n[13], n[14], n[15]}}}};
}

/// Rotations by the shorter ways from key to key.
std::vector<Numbers> poses_of(const std::vector<Matrix4>& matrices) {
  std::vector<Numbers> poses;
  Quaternion last{0, 0, 0, 1};
  for (const Matrix4& matrix : matrices) {
    Pose pose = decompose(matrix);
    if (vanishes(matrix)) pose.stretch = {};
    pose.rotation = last = vanishes(matrix) ? last : nearer(pose.rotation, last);
    poses.push_back(numbers_of(pose));
  }
  return poses;
}

Matrix4 power(Matrix4 base, std::uint64_t exponent) {
  Matrix4 r;
  for (; exponent > 0; exponent /= 2, base = base * base)
    if (exponent % 2 == 1) r = r * base;
  return r;
}

/// Goes on from `last` as often as from `first` to it.
TransformOp carried_on(TransformOp op, const TransformOp& first, const TransformOp& last, std::uint64_t cycles) {
  if (op.kind == OpKind::matrix)
    return matrix_op(power(last.matrix() * first.matrix().inverse().value_or(kZeroMatrix), cycles) * op.matrix());
  for (std::size_t i = 0; i < op.arguments.size(); ++i)
    op.arguments[i] += static_cast<double>(cycles) * (last.arguments[i] - first.arguments[i]);
  return op;
}

/// Where what LookAts name is at one moment.
class NamedPoints {
 public:
  explicit NamedPoints(Moment moment) : moment_(moment) {}

  /// With the points that it names as numbers, in the space that `from_world` leads to.
  TransformOp in(TransformOp op, const Matrix4& from_world) {
    for (std::size_t which = 0; which < op.places.size(); ++which) {
      if (!op.places[which] || !op.places[which]->world_from_place) continue;
      const Matrix4 place = from_world * world_from(*op.places[which]);
      for (std::size_t i = 0; i < 3; ++i) op.arguments[3 * which + i] = place.m[i][3];
    }
    return op;
  }

 private:
  /// Computed once: it may look at something in turn.
  const Matrix4& world_from(const NamedPlace& place) {
    const auto [known, is_new] = known_.try_emplace(&place);
    if (is_new) known->second = place.world_from_place->at(moment_);
    return known->second;
  }

  Moment moment_;
  std::map<const NamedPlace*, Matrix4> known_;
};

}  // namespace

std::size_t argument_count(OpKind kind) { return quantities(kind).back().first + quantities(kind).back().count; }

TransformOp matrix_op(const Matrix4& matrix) {
  TransformOp op{OpKind::matrix};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) op.arguments[4 * column + row] = matrix.m[row][column];
  return op;
}

bool same_sequence(const Ops& a, const Ops& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const TransformOp& x, const TransformOp& y) { return x.kind == y.kind; });
}

Matrix4 TransformOp::matrix() const {
  const auto& v = arguments;
  switch (kind) {
    case OpKind::translate: return Matrix4::translate(v[0], v[1], v[2]);
    case OpKind::rotate: {
      const double length2 = v[1] * v[1] + v[2] * v[2] + v[3] * v[3];
      return length2 > 0 && std::isfinite(length2) ? Matrix4::rotate(v[0], v[1], v[2], v[3]) : kZeroMatrix;
    }
    case OpKind::scale: return Matrix4::scale(v[0], v[1], v[2]);
    case OpKind::look_at: {
      if (std::any_of(places.begin(), places.end(), [](const auto& p) { return p && !p->world_from_place; })) return {};
      const Matrix4 view =
          Matrix4::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}).value_or(kZeroMatrix);
      return places_things ? view.inverse().value_or(kZeroMatrix) : view;
    }
    case OpKind::matrix: break;
  }
  return Matrix4::from_columns(v);
}

KeyedTransform::KeyedTransform(std::vector<TransformKey> keys, After after, Ease usual)
    : keys_(std::move(keys)),
      after_(after),
      usual_(usual),
      goes_by_arguments_(std::all_of(keys_.begin(), keys_.end(), [&](const TransformKey& key) {
        return same_sequence(key.ops, keys_.front().ops);
      })) {
  const auto is_cubic = [&](const TransformKey& key) { return key.ease.value_or(usual_) == Ease::cubic; };
  is_cubic_ = std::all_of(keys_.begin(), keys_.end() - 1, is_cubic);
  for (const TransformKey& key : keys_)
    for (const TransformOp& op : key.ops) {
      is_aimed_ = is_aimed_ || op.is_aimed();
      places_things_ = places_things_ || op.places_things;
    }
  if (std::none_of(keys_.begin(), keys_.end() - 1, is_cubic)) return;
  for (std::size_t i = 0; i < (goes_by_arguments_ ? keys_.front().ops.size() : 1); ++i) {
    std::vector<Matrix4> matrices;
    if (!goes_by_arguments_ || keys_.front().ops[i].kind == OpKind::matrix)
      for (const TransformKey& key : keys_)
        matrices.push_back(goes_by_arguments_ ? key.ops[i].matrix() : product(key.ops));
    poses_.push_back(poses_of(matrices));
  }
}

KeyedTransform KeyedTransform::of_camera() const {
  std::vector<TransformKey> keys = keys_;
  for (TransformKey& key : keys)
    for (TransformOp& op : key.ops) op.places_things = false;
  return KeyedTransform(std::move(keys), after_, keys_.size() >= 3 ? Ease::cubic : usual_);
}

Matrix4 KeyedTransform::at(Moment moment, const Matrix4& from_world) const {
  const Place place = place_of(moment);
  return goes_by_arguments_ ? at_by_arguments(place, moment, from_world) : at_by_products(place);
}

/// A cycle ends with its last key: one that does not meet its first key jumps after that.
KeyedTransform::Place KeyedTransform::place_of(Moment moment) const {
  const Moment first = keys_.front().moment, last = keys_.back().moment;
  std::uint64_t cycles = 0;
  if (after_ != After::hold && moment > last) {
    const double period = last.frames() - first.frames(), passed = moment.frames() - first.frames(),
                 rest = std::fmod(passed, period), in_cycle = rest == 0 ? period : rest;
    cycles = static_cast<std::uint64_t>(std::llround((passed - in_cycle) / period));
    moment = Moment(first.frames() + in_cycle);
  }
  const auto next = std::upper_bound(keys_.begin(), keys_.end(), moment,
                                     [](Moment m, const TransformKey& key) { return m < key.moment; });
  if (next == keys_.begin()) return {0, 0, cycles};
  const TransformKey& from = *(next - 1);
  const auto key = static_cast<std::size_t>(next - keys_.begin()) - 1;
  if (next == keys_.end() || from.moment == moment || ease(key) == Ease::step) return {key, 0, cycles};
  return {key, fraction(from.moment, next->moment, moment), cycles};
}

Matrix4 KeyedTransform::at_by_arguments(const Place& place, Moment moment, Matrix4 from_world) const {
  const std::size_t count = keys_.front().ops.size();
  // A LookAt sees what it names through those between it and the world.
  const bool is_backward = is_aimed_ && !places_things_;
  NamedPoints points(moment);
  Matrix4 r;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = is_backward ? count - 1 - n : n;
    const auto op_of = [&](std::size_t key) {
      const TransformOp& op = keys_[key].ops[i];
      return is_aimed_ ? points.in(op, from_world) : op;
    };
    TransformOp op = between(place, i, op_of);
    if (place.cycles > 0 && after_ == After::offset)
      op = carried_on(op, op_of(0), op_of(keys_.size() - 1), place.cycles);
    const Matrix4 matrix = op.matrix();
    r = is_backward ? matrix * r : r * matrix;
    if (is_aimed_) from_world = (is_backward ? matrix : matrix.inverse().value_or(kZeroMatrix)) * from_world;
  }
  return r;
}

Matrix4 KeyedTransform::at_by_products(const Place& place) const {
  const TransformKey& key = keys_[place.key];
  const auto product_of = [&](std::size_t k) { return matrix_op(product(keys_[k].ops)); };
  TransformOp op = product_of(place.key);
  if (place.t > 0 && ease(place.key) != Ease::cubic && same_sequence(key.ops, keys_[place.key + 1].ops)) {
    Matrix4 r;
    for (std::size_t i = 0; i < key.ops.size(); ++i)
      r = r * between(place, i, [&](std::size_t k) { return keys_[k].ops[i]; }).matrix();
    op = matrix_op(r);
  } else if (place.t > 0) {
    op = between(place, 0, product_of);
  }
  if (place.cycles > 0 && after_ == After::offset)
    op = carried_on(op, product_of(0), product_of(keys_.size() - 1), place.cycles);
  return op.matrix();
}

template <class OpOf>
TransformOp KeyedTransform::between(const Place& place, std::size_t op, OpOf&& op_of) const {
  TransformOp from = op_of(place.key);
  const TransformKey& key = keys_[place.key];
  if (place.t == 0) return from;
  if (ease(place.key) == Ease::cubic) return on_cubic(place, op, op_of);
  const TransformOp to = op_of(place.key + 1);
  const double t = eased(place.t, ease(place.key));
  if (from.kind == OpKind::matrix) return matrix_op(interpolate(from.matrix(), to.matrix(), t, key.turns));
  for (std::size_t i = 0; i < from.arguments.size(); ++i)
    from.arguments[i] = mix(from.arguments[i], to.arguments[i], t);
  return from;
}

template <class OpOf>
TransformOp KeyedTransform::on_cubic(const Place& place, std::size_t op, OpOf&& op_of) const {
  TransformOp result = op_of(place.key);
  if (result.kind == OpKind::matrix) {
    const bool is_still = result.arguments == op_of(place.key + 1).arguments;  // decomposing it would round
    return is_still ? result : matrix_op(on_cubic_poses(place, poses_[op]));
  }
  const CubicRun run = run_around(place.key);
  const auto value = [&](std::size_t key) { return op_of(key).arguments; };
  const auto moment = [&](std::size_t key) { return keys_[key].moment.frames(); };
  const auto given = [&](std::size_t key, std::size_t argument, bool leaves) {
    const bool is_named = argument < 6 && result.places[argument / 3];
    return is_named ? std::nullopt : tangent(key, op, argument, leaves);
  };
  const Numbers first = value(run.first), last = value(run.last);
  for (const Quantity& quantity : quantities(result.kind)) {
    CubicRun own = run;
    own.loops = run.loops &&
                (after_ == After::offset ||
                 std::equal(&first[quantity.first], &first[quantity.first] + quantity.count, &last[quantity.first]));
    const Numbers there = CubicWay(own, value, moment, given).at(place.key, place.t, quantity);
    std::copy_n(&there[quantity.first], quantity.count, &result.arguments[quantity.first]);
  }
  return result;
}

Matrix4 KeyedTransform::on_cubic_poses(const Place& place, const std::vector<Numbers>& poses) const {
  CubicRun run = run_around(place.key);
  run.loops = run.loops && poses.front() == poses.back();
  const CubicWay way(
      run, [&](std::size_t key) { return poses[key]; }, [&](std::size_t key) { return keys_[key].moment.frames(); },
      [](std::size_t, std::size_t, bool) { return std::optional<double>(); });
  Numbers pose{};
  for (const Quantity& quantity : quantities(OpKind::matrix)) {
    const Numbers there = way.at(place.key, place.t, quantity);
    std::copy_n(&there[quantity.first], quantity.count, &pose[quantity.first]);
  }
  return compose_turning(pose_of(pose), rotation_in(poses[place.key]), rotation_in(poses[place.key + 1]), place.t,
                         keys_[place.key].turns);
}

/// A key that is left otherwise ends it; three keys away, none matters.
CubicRun KeyedTransform::run_around(std::size_t key) const {
  if (is_cubic_) return {0, keys_.size() - 1, after_ != After::hold};
  CubicRun run{key, key + 1};
  while (run.first > 0 && run.first + 3 > key && ease(run.first - 1) == Ease::cubic) --run.first;
  while (run.last + 1 < keys_.size() && run.last < key + 4 && ease(run.last) == Ease::cubic) ++run.last;
  return run;
}

std::optional<double> KeyedTransform::tangent(std::size_t key, std::size_t op, std::size_t argument,
                                              bool leaves) const {
  const std::vector<double>& given = leaves ? keys_[key].tangent_out : keys_[key].tangent_in;
  if (given.empty()) return std::nullopt;
  for (std::size_t i = 0; i < op; ++i) argument += argument_count(keys_[key].ops[i].kind);
  return given[argument];
}

}  // namespace dspm
