#include "bench/plots/frame.h"

namespace dspm {

void draw_frame(Svg& svg, const PlotArea& area, const std::string& title, const Axis& y, const std::string& y_label) {
  svg.text({area.left, 22}, title, Anchor::start, {}, 14);
  for (const double tick : y.ticks) {
    const double at = area.y(y.position(tick));
    svg.line({area.left, at}, {area.right, at}, {.faint = true});
    svg.text({area.left - 7, at + 4}, tick_label(tick), Anchor::end);
  }
  svg.line({area.left, area.bottom}, {area.right, area.bottom}, {});
  svg.upright_text({16, (area.top + area.bottom) / 2}, y_label);
}

}  // namespace dspm
