#include "bench/plots/plots.h"

#include <gtest/gtest.h>

#include <regex>

#include "bench/plots/svg.h"

namespace dspm {
namespace plots_test {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; at += word.size()) ++n;
  return n;
}

/// Every number of these attributes.
std::vector<double> numbers(const std::string& svg, const std::string& attribute) {
  std::vector<double> values;
  const std::regex pattern(" " + attribute + "=\"(-?[0-9.]+)\"");
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i)
    values.push_back(std::stod((*i)[1]));
  return values;
}

const LinePlot kLines{"Title",
                      "x",
                      "y",
                      Scale::linear,
                      Scale::logarithmic,
                      {},
                      {{"first & last", {{1, 10}, {2, 100}}}, {"second", {{1, 20}, {2, -5}, {3, 90}}}, {"none", {}}}};

TEST(LinePlot, DrawsEveryPointThatItsAxesCanShow) {
  const std::string svg = svg_of(kLines);
  EXPECT_EQ(count(svg, "<circle"), 4u);
  EXPECT_EQ(count(svg, "<polyline"), 2u);
  EXPECT_NE(svg.find("first &amp; last</text>"), std::string::npos);
  EXPECT_EQ(svg.find(">none<"), std::string::npos);
}

TEST(LinePlot, StaysWithinItsPaper) {
  const std::string svg = svg_of(kLines);
  for (const char* attribute : {"x", "x1", "x2", "cx"})
    for (const double x : numbers(svg, attribute)) EXPECT_TRUE(0 <= x && x <= 720) << attribute << " " << x;
  for (const char* attribute : {"y", "y1", "y2", "cy"})
    for (const double y : numbers(svg, attribute)) EXPECT_TRUE(0 <= y && y <= 380) << attribute << " " << y;
}

TEST(LinePlot, KeepsNamesApart) {
  LinePlot plot{"Title", "x", "y", Scale::linear, Scale::linear, {}, {}};
  for (int i = 0; i < 6; ++i) plot.series.push_back({"name", {{0, 1}, {1, 2}}});
  const std::string svg = svg_of(plot);
  std::vector<double> heights;
  const std::regex pattern("y=\"([0-9.]+)\"[^>]*>name<");
  for (std::sregex_iterator i(svg.begin(), svg.end(), pattern), end; i != end; ++i)
    heights.push_back(std::stod((*i)[1]));
  ASSERT_EQ(heights.size(), 6u);
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 1; i < heights.size(); ++i) EXPECT_GE(heights[i] - heights[i - 1], 12);
}

TEST(BarPlot, DrawsABarForEveryValueAboveZero) {
  const BarPlot plot{"Title", "y", {"a", "b"}, {{"one", {1, 2}}, {"two", {0, 4}, true}}};
  const std::string svg = svg_of(plot);
  EXPECT_EQ(count(svg, "<rect"), 3u + 2u + 1u);  // bars, legend, paper
  const std::vector<double> heights = numbers(svg, "height");
  EXPECT_NEAR(*std::max_element(heights.begin() + 2, heights.end()), 280, 0.1);  // the axis ends at 4
}

TEST(Svg, EscapesWords) { EXPECT_EQ(escaped("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;"); }

}  // namespace plots_test
}  // namespace dspm
