#include <algorithm>
#include <cmath>

#include "bench/plots/frame.h"
#include "bench/plots/plots.h"

namespace dspm {
namespace {

constexpr int kWidth = 720, kHeight = 380;
constexpr double kLabelGap = 15;  // pixels between the names of series, at least
constexpr double kSample = 18;    // of a line, before its name

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

/// A series' name at the right, about where its line ends.
struct Label {
  int series;
  double y;
};

/// Moves labels apart where lines end close together; none falls below `bottom`.
void spread(std::vector<Label>& labels, double bottom) {
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
  for (std::size_t i = 1; i < labels.size(); ++i) labels[i].y = std::max(labels[i].y, labels[i - 1].y + kLabelGap);
  double limit = bottom;
  for (auto label = labels.rbegin(); label != labels.rend(); ++label, limit -= kLabelGap)
    label->y = std::min(label->y, limit);
}

void draw_labels(Svg& svg, const PlotArea& area, const LinePlot& plot, std::vector<Label> labels) {
  spread(labels, area.bottom);
  for (const Label& label : labels) {
    const LineSeries& series = plot.series[static_cast<std::size_t>(label.series)];
    const double left = area.right + 10;
    svg.line({left, label.y}, {left + kSample, label.y}, {.series = label.series, .dashed = series.dashed});
    svg.text({left + kSample + 6, label.y + 4}, series.name, Anchor::start, {.series = label.series});
  }
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
  area.right = kWidth - 34 - kSample - widest_name(plot);
  Svg svg(kWidth, kHeight, plot.title);
  draw_frame(svg, area, plot.title, y, plot.y_label);
  draw_x_axis(svg, area, x, plot.x_label);

  std::vector<Label> labels;
  for (int s = 0; s < static_cast<int>(plot.series.size()); ++s) {
    const LineSeries& series = plot.series[static_cast<std::size_t>(s)];
    std::vector<SvgPoint> points;
    for (const PlotPoint& p : series.points)
      if (shown(p.x, x.scale) && shown(p.y, y.scale))
        points.push_back({area.x(x.position(p.x)), area.y(y.position(p.y))});
    if (points.empty()) continue;
    svg.polyline(points, {.series = s, .dashed = series.dashed});
    for (const SvgPoint& p : points) svg.dot(p, {.series = s});
    labels.push_back({s, points.back().y});
  }
  draw_labels(svg, area, plot, std::move(labels));
  return svg.finished();
}

}  // namespace dspm
