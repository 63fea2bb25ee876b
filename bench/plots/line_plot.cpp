#include <algorithm>
#include <cmath>

#include "bench/plots/frame.h"
#include "bench/plots/plots.h"

namespace dspm {
namespace {

constexpr int kWidth = 720, kHeight = 380;
constexpr double kLabelGap = 15;  // pixels between the names of series, at least

bool shown(double value, Scale scale) { return std::isfinite(value) && (scale == Scale::linear || value > 0); }

std::vector<double> all(const LinePlot& plot, double PlotPoint::*coordinate) {
  std::vector<double> values;
  for (const LineSeries& series : plot.series)
    for (const PlotPoint& p : series.points) values.push_back(p.*coordinate);
  return values;
}

double widest_name(const LinePlot& plot) {
  double width = 0;
  for (const LineSeries& series : plot.series) width = std::max(width, text_width(series.name));
  return width;
}

/// A series' name beside the end of its line.
struct EndLabel {
  int series;
  SvgPoint at;
};

/// Moves labels apart where lines end close together; the first of all stays at or below `top`, none falls below
/// `bottom`.
void spread(std::vector<EndLabel>& labels, double bottom) {
  std::sort(labels.begin(), labels.end(), [](const EndLabel& a, const EndLabel& b) { return a.at.y < b.at.y; });
  for (std::size_t i = 1; i < labels.size(); ++i)
    labels[i].at.y = std::max(labels[i].at.y, labels[i - 1].at.y + kLabelGap);
  double limit = bottom;
  for (auto label = labels.rbegin(); label != labels.rend(); ++label, limit -= kLabelGap)
    label->at.y = std::min(label->at.y, limit);
}

void draw_x_axis(Svg& svg, const PlotArea& area, const Axis& x, const std::string& label) {
  for (const double tick : x.ticks) {
    const double at = area.x(x.position(tick));
    svg.line({at, area.bottom}, {at, area.bottom + 4}, {});
    svg.text({at, area.bottom + 18}, tick_label(tick), Anchor::middle);
  }
  svg.text({(area.left + area.right) / 2, area.bottom + 38}, label, Anchor::middle);
}

}  // namespace

std::string svg_of(const LinePlot& plot) {
  const Axis x =
      plot.x_ticks.empty() ? axis_for(all(plot, &PlotPoint::x), plot.x_scale) : axis_of(plot.x_ticks, plot.x_scale);
  const Axis y = axis_for(all(plot, &PlotPoint::y), plot.y_scale);
  PlotArea area;
  area.right = kWidth - 24 - widest_name(plot);
  Svg svg(kWidth, kHeight, plot.title);
  draw_frame(svg, area, plot.title, y, plot.y_label);
  draw_x_axis(svg, area, x, plot.x_label);

  std::vector<EndLabel> labels;
  for (int s = 0; s < static_cast<int>(plot.series.size()); ++s) {
    const LineSeries& series = plot.series[static_cast<std::size_t>(s)];
    std::vector<SvgPoint> points;
    for (const PlotPoint& p : series.points)
      if (shown(p.x, x.scale) && shown(p.y, y.scale))
        points.push_back({area.x(x.position(p.x)), area.y(y.position(p.y))});
    if (points.empty()) continue;
    svg.polyline(points, {.series = s, .dashed = series.dashed});
    for (const SvgPoint& p : points) svg.dot(p, {.series = s});
    labels.push_back({s, {points.back().x + 8, points.back().y + 4}});
  }
  spread(labels, area.bottom + 4);
  for (const EndLabel& label : labels)
    svg.text(label.at, plot.series[static_cast<std::size_t>(label.series)].name, Anchor::start,
             {.series = label.series});
  return svg.finished();
}

}  // namespace dspm
