// A drawing in SVG: lines, areas and words. It follows the reader's light or dark scheme by itself, with its own paper
// below, so that it can be read wherever it is shown. No scripts, no fonts of its own.
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
  bool dashed = false;  // what is not measured but compared with
};

class Svg {
 public:
  /// `title` is what a reader hears who cannot see it.
  Svg(int width, int height, std::string_view title);

  void line(SvgPoint from, SvgPoint to, SvgStyle style);
  void polyline(std::span<const SvgPoint> points, SvgStyle style);
  void dot(SvgPoint centre, SvgStyle style);
  void rectangle(SvgPoint corner, double width, double height, SvgStyle style);
  void text(SvgPoint at, std::string_view words, Anchor anchor, SvgStyle style = {}, int size = 12);
  /// Read from below, along a vertical axis.
  void upright_text(SvgPoint middle, std::string_view words);

  std::string finished() const { return body_ + "</svg>\n"; }

 private:
  std::string body_;
};

/// How wide the words will be, about, in pixels.
double text_width(std::string_view words, int size = 12);

/// `text` as XML wants it.
std::string escaped(std::string_view text);

}  // namespace dspm
