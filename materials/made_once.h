// Tables that take time, made once for each index of refraction.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <mutex>

namespace dspm {

/// Keeps what make(key) returns, made once, for many threads. A table takes kilobytes and a fifteenth of a second, and
/// the looks of long animations are made several times.
template <class T>
class MadeOnce {
 public:
  template <class Make>
  std::shared_ptr<const T> of(float key, Make&& make) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const T>& object = made_[key];
    if (!object) object = std::make_shared<const T>(make(key));
    return object;
  }

 private:
  std::mutex mutex_;
  std::map<float, std::shared_ptr<const T>> made_;
};

/// Returns make(eta) or, above 1.05, as animated indices are many, between(a, b, share) of the tables at multiples of
/// 0.05.
template <class T, class Make, class Between>
std::shared_ptr<const T> made_for_index(MadeOnce<T>& made, float eta, const Make& make, const Between& between) {
  constexpr float kStepsPerUnit = 20;
  constexpr float kFirstStep = 21;  // before, total reflection has its onset close to the horizon
  const float steps = eta * kStepsPerUnit;
  if (steps < kFirstStep || std::abs(steps - std::round(steps)) < 1e-3f) return made.of(eta, make);
  const float below = std::floor(steps);
  const auto a = made.of(below / kStepsPerUnit, make), b = made.of((below + 1) / kStepsPerUnit, make);
  return made.of(eta, [&](float) { return between(*a, *b, steps - below); });
}

}  // namespace dspm
