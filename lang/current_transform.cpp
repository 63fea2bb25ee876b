#include "dspm/lang/current_transform.h"

#include "dspm/base/math/vanishing.h"
#include "dspm/lang/keyed_transform.h"

namespace dspm {
namespace {

Motion between(const TransformTimes& times, const Matrix4& start, const Matrix4& end) {
  Motion motion;
  motion.multiply(KeyedTransform({{times.start, Ease::linear, {matrix_op(start)}}, {times.end, {}, {matrix_op(end)}}}));
  return motion;
}

}  // namespace

Motion CurrentTransform::motion(const TransformTimes& times) const {
  return differs() ? between(times, start_.at(times.start), end_->at(times.end)) : start_;
}

Motion CurrentTransform::of_camera(const TransformTimes& times) const {
  if (!differs()) return start_.of_camera();
  const Motion start = start_.inverse(), end = end_->inverse();
  return between(times, start.at(times.start), end.at(times.end)).inverse();
}

}  // namespace dspm
