// A drawing in SVG: lines, areas and words. It follows the reader's light or dark scheme, on its own background, so
// that it is readable wherever it is shown. No scripts, no fonts of its own.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dspm {

struct SvgPoint {
  double x, y;  // from the upper left, in pixels
};

enum class Anchor { start, middle, end };

/// How something is drawn: a class of the drawing's style sheet. Series have colours of their own.
struct SvgStyle {
  int series = -1;      // < 0: the colour of text and axes
  bool faint = false;   // grid lines
  bool dashed = false;  // compared with, not measured
};

class Svg {
 public:
  /// `title` is for screen readers.
  Svg(int width, int height, std::string_view title);

  void line(SvgPoint from, SvgPoint to, SvgStyle style);
  void polyline(std::span<const SvgPoint> points, SvgStyle style);
  void dot(SvgPoint centre, SvgStyle style);
  void rectangle(SvgPoint corner, double width, double height, SvgStyle style);
  void text(SvgPoint at, std::string_view words, Anchor anchor, SvgStyle style = {}, int size = 12);
  /// Upwards along a vertical axis.
  void upright_text(SvgPoint middle, std::string_view words);

  std::string finished() const { return body_ + "</svg>\n"; }

 private:
  std::string body_;
};

/// The approximate width of the words, in pixels.
double text_width(std::string_view words, int size = 12);

/// For XML.
std::string escaped(std::string_view text);

}  // namespace dspm
