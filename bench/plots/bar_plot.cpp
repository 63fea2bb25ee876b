#include <fmt/format.h>

#include "bench/plots/frame.h"
#include "bench/plots/plots.h"

namespace dspm {
namespace {

constexpr int kWidth = 720, kHeight = 380;

Axis value_axis(const BarPlot& plot) {
  std::vector<double> values;
  for (const BarSeries& series : plot.series) values.insert(values.end(), series.values.begin(), series.values.end());
  return axis_for(values, Scale::linear);
}

/// The names of the series, in a row below the groups.
void draw_legend(Svg& svg, const PlotArea& area, const BarPlot& plot) {
  double at = area.left;
  for (int s = 0; s < static_cast<int>(plot.series.size()); ++s) {
    const BarSeries& series = plot.series[static_cast<std::size_t>(s)];
    svg.rectangle({at, area.bottom + 32}, 12, 12, {.series = s, .dashed = series.dashed});
    svg.text({at + 18, area.bottom + 42}, series.name, Anchor::start, {.series = s});
    at += 40 + text_width(series.name);
  }
}

}  // namespace

std::string svg_of(const BarPlot& plot) {
  PlotArea area;
  area.right = kWidth - 20;
  const Axis y = value_axis(plot);
  Svg svg(kWidth, kHeight, plot.title);
  draw_frame(svg, area, plot.title, y, plot.y_label);

  const double group_width = (area.right - area.left) / static_cast<double>(plot.groups.size());
  const double bar_width = 0.8 * group_width / static_cast<double>(plot.series.size());
  for (std::size_t g = 0; g < plot.groups.size(); ++g) {
    const double left = area.left + (static_cast<double>(g) + 0.1) * group_width;
    svg.text({left + 0.4 * group_width, area.bottom + 18}, plot.groups[g], Anchor::middle);
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
      const BarSeries& series = plot.series[s];
      if (g >= series.values.size() || !(series.values[g] > 0)) continue;
      const SvgPoint corner{left + static_cast<double>(s) * bar_width, area.y(y.position(series.values[g]))};
      svg.rectangle({corner.x + 1, corner.y}, bar_width - 2, area.bottom - corner.y,
                    {.series = static_cast<int>(s), .dashed = series.dashed});
      svg.text({corner.x + bar_width / 2, corner.y - 4}, fmt::format("{:.3g}", series.values[g]), Anchor::middle, {},
               10);
    }
  }
  draw_legend(svg, area, plot);
  return svg.finished();
}

}  // namespace dspm
