#include "dspm/lang/keyframe_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dspm/math/frames.h"
#include "dspm/math/vanishing.h"

namespace dspm {
namespace {

constexpr int kMostKeyed = 32;  // nested; each shape inside has a motion with that many factors

}  // namespace

TransformOp matrix_op(const Matrix4& matrix) {
  TransformOp op{TransformOp::Kind::matrix, {}};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) op.arguments[4 * column + row] = matrix.m[row][column];
  return op;
}

bool fits_float(const Matrix4& matrix) {
  for (const auto& row : matrix.m)
    for (const double v : row)
      if (!(std::abs(v) <= std::numeric_limits<float>::max())) return false;
  return true;
}

bool is_regular(const Matrix4& matrix) { return fits_float(matrix) && matrix.inverse().has_value(); }

void KeyframeGroup::begin_key(Moment moment, Ease ease, const SourceLocation& where, Diagnostics& diagnostics) {
  if (!keys_.empty() && moment <= keys_.back().moment) {
    const int last = keys_.back().moment.number();
    diagnostics.error(where, fmt::format("Keyframe {} comes after Keyframe {}", moment.number(), last),
                      "keys must be in ascending order");
    moment = Moment::numbered(last + 1);
  }
  keys_.push_back({moment, ease, {}});
  replaces_.push_back(false);
}

void KeyframeGroup::multiply(const TransformOp& op) { keys_.back().ops.push_back(op); }

void KeyframeGroup::replace(const TransformOp& op) {
  keys_.back().ops = {op};
  replaces_.back() = true;
}

Motion KeyframeGroup::finish(const Motion& before, Diagnostics& diagnostics) {
  const bool any_replaces = std::find(replaces_.begin(), replaces_.end(), true) != replaces_.end();
  const bool all_replace = std::find(replaces_.begin(), replaces_.end(), false) == replaces_.end();
  if (any_replaces && !all_replace) {
    if (before.is_keyed())
      diagnostics.error(where_, "some of these keys replace the transform before them, others do not",
                        "inside another keyed transform, all or none of them may use Transform or Identity");
    for (std::size_t i = 0; i < keys_.size(); ++i)
      if (!replaces_[i]) keys_[i].ops.insert(keys_[i].ops.begin(), matrix_op(before.at(Moment())));
  }
  KeyedTransform keyed(std::move(keys_));
  check_regular(keyed, diagnostics);
  Motion motion = any_replaces ? Motion() : before;
  if (motion.keyed_count() < kMostKeyed)
    motion.multiply(std::move(keyed));
  else
    diagnostics.error(where_, fmt::format("keyed transforms are nested more than {} deep", kMostKeyed));
  return motion;
}

void KeyframeGroup::check_regular(const KeyedTransform& keyed, Diagnostics& diagnostics) const {
  const int last = keyed.keys().back().moment.number();
  for (int number = keyed.keys().front().moment.number(); number <= last; ++number) {
    const Matrix4 matrix = keyed.at(Moment::numbered(number));
    if (is_regular(matrix) || vanishes(matrix)) continue;
    diagnostics.error(where_, fmt::format("the transform between these keys is singular at frame {}", number));
    return;
  }
}

}  // namespace dspm
