// Predicts, from the errors so far, after how many iterations an error will be reached.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace dspm {

class ErrorTrend {
 public:
  void add(int iterations, double error) {
    if (errors_.empty() || errors_.back().error != error) errors_.push_back({iterations, error});
  }
  void clear() { errors_.clear(); }
  std::optional<double> now() const { return errors_.empty() ? std::nullopt : std::optional(errors_.back().error); }

  /// The error falls as a power of the iterations: 1/2 for independent ones, less if a radius shrinks.
  std::optional<double> iterations_until(double wanted) const {
    if (errors_.empty()) return std::nullopt;
    const Estimate &last = errors_.back(), &before = *half_way();
    double power = 0.5;
    if (before.iterations < last.iterations && last.error > 0)
      power = std::log(before.error / last.error) / std::log(double(last.iterations) / before.iterations);
    return last.iterations * std::pow(std::max(last.error / wanted, 1.0), 1 / std::clamp(power, 0.3, 0.6));
  }

 private:
  struct Estimate {
    int iterations;
    double error;
  };
  /// Returns the last estimate at half of the iterations or fewer; else the first.
  std::vector<Estimate>::const_iterator half_way() const {
    const auto later = std::find_if(errors_.begin(), errors_.end(),
                                    [&](const Estimate& e) { return 2 * e.iterations > errors_.back().iterations; });
    return later == errors_.begin() ? later : later - 1;
  }

  std::vector<Estimate> errors_;
};

}  // namespace dspm
