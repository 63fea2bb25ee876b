// The current transform of a scene's text, which ActiveTransform lets differ between two times of pbrt's shutter.
#pragma once

#include <optional>
#include <utility>

#include "dspm/base/math/moments.h"
#include "dspm/lang/motion.h"

namespace dspm {

/// The times of TransformTimes: in pbrt, seconds.
struct TransformTimes {
  Moment start, end = Moment(1);
};

class CurrentTransform {
 public:
  enum class Active { both, start, end };  // the times that changes apply to

  CurrentTransform() = default;
  explicit CurrentTransform(Motion motion) : start_(std::move(motion)) {}

  void activate(Active active) { active_ = active; }
  /// Calls fn(Motion&) for each time that is active.
  template <class Fn>
  void change(Fn&& fn) {
    if (active_ != Active::both && !end_) end_ = start_;
    if (active_ != Active::end) fn(start_);
    if (end_ && active_ != Active::start) fn(*end_);
  }
  void set(const Motion& motion) {
    change([&](Motion& each) { each = motion; });
  }

  /// Returns what a thing that is placed by it does. Between the times, it goes from one to the other as a matrix with
  /// keys does.
  Motion motion(const TransformTimes& times) const;
  /// Returns the same for a camera, from whose place it is the way to the world that is interpolated.
  Motion of_camera(const TransformTimes& times) const;

 private:
  bool differs() const { return end_ && !(*end_ == start_); }

  Active active_ = Active::both;
  Motion start_;
  std::optional<Motion> end_;  // none: the same
};

}  // namespace dspm
