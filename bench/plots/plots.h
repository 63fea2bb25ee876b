// The plots of docs/results.md: lines over a number, bars over names.
#pragma once

#include <string>
#include <vector>

#include "bench/plots/axis.h"

namespace dspm {

struct PlotPoint {
  double x, y;
};

struct LineSeries {
  std::string name;
  std::vector<PlotPoint> points;
  bool dashed = false;  // not measured here: another's figures, or a limit
};

struct LinePlot {
  std::string title = {}, x_label = {}, y_label = {};
  Scale x_scale = Scale::linear, y_scale = Scale::linear;
  std::vector<double> x_ticks = {};  // empty: round numbers
  std::vector<LineSeries> series = {};
};

struct BarSeries {
  std::string name;
  std::vector<double> values;  // one per group; 0: no bar
  bool dashed = false;         // likewise
};

struct BarPlot {
  std::string title, y_label;
  std::vector<std::string> groups;
  std::vector<BarSeries> series;
};

/// As the text of an SVG file. Series keep their order and colours; points that an axis cannot show are left out.
std::string svg_of(const LinePlot& plot);
std::string svg_of(const BarPlot& plot);

}  // namespace dspm
