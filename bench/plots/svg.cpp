#include "bench/plots/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace dspm {
namespace {

// Colours that differ also for the colour-blind [Okabe and Ito 2008], on light and on dark paper.
constexpr std::array<std::array<std::string_view, 2>, 6> kColours = {{{"#0072b2", "#56b4e9"},
                                                                      {"#d55e00", "#ff8a3d"},
                                                                      {"#009e73", "#2fcf9f"},
                                                                      {"#b0528c", "#e58fc0"},
                                                                      {"#a87b00", "#f0c000"},
                                                                      {"#666", "#aaa"}}};

std::string colours(std::size_t scheme) {
  std::string rules;
  for (std::size_t s = 0; s < kColours.size(); ++s)
    rules += fmt::format(".s{0}.stroke {{ stroke: {1} }} .s{0}.fill {{ fill: {1} }}\n", s, kColours[s][scheme]);
  return rules;
}

std::string style_sheet() {
  return "<style>\n"
         "text { font-family: sans-serif; fill: #222 } .paper { fill: #fff } .ink { stroke: #222 } .grid { stroke: "
         "#ddd }\n"
         ".stroke { fill: none; stroke-width: 2 } .dashed { stroke-dasharray: 5 4 }\n" +
         colours(0) +
         "@media (prefers-color-scheme: dark) {\n"
         "text { fill: #ddd } .paper { fill: #16181c } .ink { stroke: #ddd } .grid { stroke: #3a3d44 }\n" +
         colours(1) + "}\n</style>\n";
}

std::string classes(SvgStyle style, std::string_view painted) {
  std::string words;
  if (style.series >= 0) {
    words = fmt::format("s{} {}", static_cast<std::size_t>(style.series) % kColours.size(), painted);
  } else {
    words = style.faint ? "grid" : "ink";
  }
  return style.dashed ? words + " dashed" : words;
}

std::string_view name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

}  // namespace

Svg::Svg(int width, int height, std::string_view title)
    : body_(
          fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                      "role=\"img\">\n<title>{2}</title>\n{3}<rect class=\"paper\" width=\"{0}\" height=\"{1}\"/>\n",
                      width, height, escaped(title), style_sheet())) {}

void Svg::line(SvgPoint from, SvgPoint to, SvgStyle style) {
  body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", from.x, from.y,
                       to.x, to.y, classes(style, "stroke"));
}

void Svg::polyline(std::span<const SvgPoint> points, SvgStyle style) {
  std::string coordinates;
  for (const SvgPoint& p : points) fmt::format_to(std::back_inserter(coordinates), "{:.1f},{:.1f} ", p.x, p.y);
  body_ += fmt::format("<polyline points=\"{}\" class=\"{}\"/>\n", coordinates, classes(style, "stroke"));
}

void Svg::dot(SvgPoint centre, SvgStyle style) {
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" class=\"{}\"/>\n", centre.x, centre.y,
                       classes(style, "fill"));
}

void Svg::rectangle(SvgPoint corner, double width, double height, SvgStyle style) {
  body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"{}\"/>\n", corner.x,
                       corner.y, width, height, classes(style, style.dashed ? "stroke" : "fill"));
}

void Svg::text(SvgPoint at, std::string_view words, Anchor anchor, SvgStyle style, int size) {
  const std::string colour = style.series >= 0 ? fmt::format(" class=\"{}\"", classes({style.series}, "fill")) : "";
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", at.x, at.y,
                       size, name(anchor), colour, escaped(words));
}

void Svg::upright_text(SvgPoint middle, std::string_view words) {
  body_ += fmt::format(
      "<text font-size=\"12\" text-anchor=\"middle\" transform=\"translate({:.1f} {:.1f}) rotate(-90)\">{}</text>\n",
      middle.x, middle.y, escaped(words));
}

double text_width(std::string_view words, int size) {
  const auto letters =
      std::count_if(words.begin(), words.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  return 0.58 * size * static_cast<double>(letters);
}

std::string escaped(std::string_view text) {
  std::string xml;
  for (const char c : text) {
    switch (c) {
      case '&': xml += "&amp;"; break;
      case '<': xml += "&lt;"; break;
      case '>': xml += "&gt;"; break;
      case '"': xml += "&quot;"; break;
      default: xml += c;
    }
  }
  return xml;
}

}  // namespace dspm
