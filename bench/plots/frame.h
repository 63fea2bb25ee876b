// The frame of a plot: the area within, the axes around it, the title above.
#pragma once

#include <string>

#include "bench/plots/axis.h"
#include "bench/plots/svg.h"

namespace dspm {

struct PlotArea {
  double left = 62, top = 40, right = 560, bottom = 320;

  double x(double position) const { return left + position * (right - left); }
  double y(double position) const { return bottom - position * (bottom - top); }
};

/// Title, vertical axis with grid lines and label, and the line below.
void draw_frame(Svg& svg, const PlotArea& area, const std::string& title, const Axis& y, const std::string& y_label);

}  // namespace dspm
