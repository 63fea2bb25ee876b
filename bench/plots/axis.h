// An axis of a plot: which values it spans, where they lie, and where it has ticks.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace dspm {

enum class Scale { linear, logarithmic };

struct Axis {
  Scale scale = Scale::linear;
  double low = 0, high = 1;  // low < high; both positive on a logarithmic axis
  std::vector<double> ticks;

  /// 0 at `low`, 1 at `high`.
  double position(double value) const;
};

/// Spans all values, and 0 as well on a linear axis. Ticks are 1, 2 or 5 times powers of ten; a logarithmic axis over
/// two decades and more has the powers only. Values that a logarithmic axis cannot show are ignored.
Axis axis_for(std::span<const double> values, Scale scale);

/// An axis with a tick at each of the values.
Axis axis_of(std::span<const double> values, Scale scale);

/// "0.05", "1", "200", "10,000".
std::string tick_label(double value);

}  // namespace dspm
