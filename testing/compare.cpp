#include "dspm/testing/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"

namespace dspm {

namespace {

void check_sizes(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument("images of different sizes cannot be compared");
}

/// Calls fn(value, reference) for every channel of every pixel.
template <class Fn>
void for_each_value(const Image& image, const Image& reference, Fn&& fn) {
  check_sizes(image, reference);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) fn(double{image.pixels[i][c]}, double{reference.pixels[i][c]});
  }
}

double value_count(const Image& image) { return 3.0 * static_cast<double>(image.pixels.size()); }

Rgb mean_within(const Image& image, int x0, int y0, int x1, int y1) {
  std::array<double, 3> sum{};
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)] += image.at(x, y)[c];
    }
  }
  const double count = static_cast<double>(x1 - x0) * (y1 - y0);
  const auto share = [count](double s) { return static_cast<float>(s / count); };
  return {share(sum[0]), share(sum[1]), share(sum[2])};
}

}  // namespace

Rgb mean(const Image& image) { return mean_within(image, 0, 0, image.width, image.height); }

double root_mean_squared_error(const Image& image, const Image& reference) {
  double sum = 0;
  for_each_value(image, reference, [&](double a, double b) { sum += (a - b) * (a - b); });
  return std::sqrt(sum / value_count(image));
}

double relative_mean_squared_error(const Image& image, const Image& reference) {
  double sum = 0;
  for_each_value(image, reference, [&](double a, double b) { sum += (a - b) * (a - b) / (b * b + 0.01); });
  return sum / value_count(image);
}

double max_difference(const Image& image, const Image& reference) {
  double largest = 0;
  for_each_value(image, reference, [&](double a, double b) {
    const double difference = std::abs(a - b);
    if (difference > largest || std::isnan(difference)) largest = difference;  // once NaN, it stays NaN
  });
  return largest;
}

std::vector<TileMeans> compare_tiles(const Image& image, const Image& reference, int tile_size) {
  check_sizes(image, reference);
  std::vector<TileMeans> tiles;
  for (int y = 0; y < image.height; y += tile_size) {
    for (int x = 0; x < image.width; x += tile_size) {
      const int x1 = std::min(x + tile_size, image.width), y1 = std::min(y + tile_size, image.height);
      tiles.push_back({x, y, mean_within(image, x, y, x1, y1), mean_within(reference, x, y, x1, y1)});
    }
  }
  return tiles;
}

}  // namespace dspm
