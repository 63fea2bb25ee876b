#include "bench/plots/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dspm {
namespace {

constexpr double kMostSteps = 6;  // between ticks of a linear axis
constexpr double kSlack = 1e-9;   // of a step: ticks that rounding moved

/// The smallest of 1, 2 and 5 times powers of ten that is not below `least`.
double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least) + kSlack));
  for (const double digit : {1., 2., 5.})
    if (digit * power >= least * (1 - kSlack)) return digit * power;
  return 10 * power;
}

Axis linear_axis(double low, double high) {
  if (low == high) high = low + 1;
  const double step = round_step((high - low) / kMostSteps);
  Axis axis{Scale::linear, std::floor(low / step + kSlack) * step, std::ceil(high / step - kSlack) * step, {}};
  const auto count = std::lround((axis.high - axis.low) / step);
  for (long i = 0; i <= count; ++i) axis.ticks.push_back(axis.low + static_cast<double>(i) * step);
  return axis;
}

Axis logarithmic_axis(double low, double high) {
  if (low == high) low /= 2, high *= 2;
  const bool powers_only = high / low >= 100;
  std::vector<double> marks;
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  for (int exponent = first; exponent <= last; ++exponent)
    for (const double digit : {1., 2., 5.})
      if (digit == 1 || !powers_only) marks.push_back(digit * std::pow(10, exponent));
  // From the last mark at or below `low` to the first at or above `high`.
  const auto begin = std::upper_bound(marks.begin(), marks.end(), low * (1 + kSlack)) - 1;
  const auto end = std::lower_bound(marks.begin(), marks.end(), high * (1 - kSlack)) + 1;
  return {Scale::logarithmic, *begin, *(end - 1), std::vector<double>(begin, end)};
}

}  // namespace

double Axis::position(double value) const {
  if (scale == Scale::linear) return (value - low) / (high - low);
  return std::log(value / low) / std::log(high / low);
}

Axis axis_for(std::span<const double> values, Scale scale) {
  double low = 0, high = 0;
  bool any = scale == Scale::linear;  // 0 is included
  for (const double value : values) {
    if (!std::isfinite(value) || (scale == Scale::logarithmic && value <= 0)) continue;
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
  if (scale == Scale::linear) return linear_axis(low, high);
  return any ? logarithmic_axis(low, high) : logarithmic_axis(1, 10);
}

Axis axis_of(std::span<const double> values, Scale scale) {
  Axis axis = axis_for(values, scale);
  axis.ticks.assign(values.begin(), values.end());
  if (scale == Scale::logarithmic && values.size() > 1) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    axis.low = *low, axis.high = *high;
  }
  return axis;
}

std::string tick_label(double value) {
  if (std::abs(value) < 1e-12) return "0";
  if (std::abs(value) < 10000) return fmt::format("{:.4g}", value);
  std::string digits = fmt::format("{:.0f}", value);
  for (std::size_t at = digits.size(); at > 3 && digits[at - 4] != '-';) digits.insert(at -= 3, 1, ',');
  return digits;
}

}  // namespace dspm
