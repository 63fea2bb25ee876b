#include "dspm/lights/background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

constexpr float kSmallestBlur = 0.5f, kLargestBlur = 90;  // degrees
constexpr int kMostRows = 256, kFewestRows = 8;
constexpr int kDirections = 256;

/// The two cells, of `cells` along a side, that pixel i of `count` may lie in, and how much of each it covers.
std::array<std::pair<int, float>, 2> cells_of(int i, int count, int cells) {
  const double scale = static_cast<double>(cells) / count, low = i * scale, high = low + scale;
  const int first = std::min(static_cast<int>(low), cells - 1);
  const double edge = std::min(first + 1.0, high);
  return {{{first, static_cast<float>(edge - low)}, {std::min(first + 1, cells - 1), static_cast<float>(high - edge)}}};
}

/// The means over width x height cells; no more than there are pixels.
Image reduced(const Image& image, int width, int height) {
  Image means(width, height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (const auto& [row, down] : cells_of(y, image.height, height))
        for (const auto& [column, across] : cells_of(x, image.width, width))
          means.at(column, row) += image.at(x, y) * (down * across);
  return means;
}

/// As coarse as a Gaussian of `sigma` radians allows: it is sampled by few directions, between which nothing may hide.
Image coarse(const Image& image, float sigma) {
  const float pixel = std::sqrt(4 * kPi / (static_cast<float>(image.width) * static_cast<float>(image.height)));
  const float share = std::min(1.f, pixel * 6 / sigma);
  const auto side = [&](int pixels) {
    return std::max(1, static_cast<int>(std::lround(share * static_cast<float>(pixels))));
  };
  return share < 1 ? reduced(image, side(image.width), side(image.height)) : image;
}

/// Directions around +z with equal weights.
std::vector<Vec3> gaussian(float sigma) {
  std::vector<Vec3> directions;
  const float golden = kPi * (3 - std::sqrt(5.f));
  for (int i = 0; i < kDirections; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / kDirections, phi = static_cast<float>(i) * golden;
    const float theta = std::min(kPi, sigma * std::sqrt(-2 * rounded::log(1 - u)));
    directions.push_back(
        {rounded::sin(theta) * rounded::cos(phi), rounded::sin(theta) * rounded::sin(phi), rounded::cos(theta)});
  }
  return directions;
}

}  // namespace

BackgroundChoice read_background(ParamReader& reader) {
  BackgroundChoice choice;
  const Rgb colour = reader.rgb("background", Rgb(), SpectrumRole::illuminant,
                                "radiance that the camera sees behind everything, instead of the light");
  if (reader.has("background")) choice.colour = colour;
  choice.blur = reader.number("backgroundblur", 0, "degrees",
                              "how much the camera sees the light's image blurred behind everything; 0: not");
  if (choice.blur != 0 && !(choice.blur >= kSmallestBlur && choice.blur <= kLargestBlur)) {
    reader.error("backgroundblur", "\"backgroundblur\" must be 0, or between 0.5 and 90 degrees");
    choice.blur = 0;
  }
  if (choice.colour && choice.blur > 0)
    reader.error("backgroundblur", "the background is either of one colour or blurred, not both");
  return choice;
}

EnvironmentMap blurred(const Image& image, SphereMapping mapping, float sigma) {
  const float radians = sigma * kPi / 180;
  const EnvironmentMap sharp(coarse(image, radians), mapping);
  const std::vector<Vec3> around = gaussian(radians);
  const int rows = std::clamp(static_cast<int>(std::ceil(2 * kPi / radians)), kFewestRows, kMostRows);
  Image result(2 * rows, rows);
  parallel_for(rows, 1, [&](std::int64_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < result.width; ++x) {
      const Vec2 place{(static_cast<float>(x) + 0.5f) / static_cast<float>(result.width),
                       (static_cast<float>(y) + 0.5f) / static_cast<float>(rows)};
      const Basis basis = Basis::around(direction_at(SphereMapping::equirectangular, place));
      Rgb sum;
      for (const Vec3& w : around) sum += sharp.radiance(basis.to_world(w));
      result.at(x, y) = sum / static_cast<float>(kDirections);
    }
  });
  return EnvironmentMap(result, SphereMapping::equirectangular);
}

}  // namespace dspm
