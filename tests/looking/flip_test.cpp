// FLIP against a slow twin that follows the paper word by word: whole kernels of two dimensions, pixel by pixel.
#include "dspm/looking/flip.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "dspm/base/colour/rgb.h"

namespace dspm {
namespace flip_test {

using std::numbers::pi;
using Colour = std::array<double, 3>;
constexpr double kPixelsPerDegree = 20;  // small kernels

Image random_image(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> level(0, 1);
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = {level(random), level(random), level(random)};
  return image;
}

Colour xyz_over_white(const Colour& c) {
  return {(0.4123863 * c[0] + 0.3575915 * c[1] + 0.1804505 * c[2]) / 0.950428545,
          0.2126368 * c[0] + 0.7151830 * c[1] + 0.0721802 * c[2],
          (0.0193306 * c[0] + 0.1191972 * c[1] + 0.9503726 * c[2]) / 1.088900371};
}

Colour to_ycxcz(const Rgb& rgb) {
  const Colour v = xyz_over_white({rgb.r, rgb.g, rgb.b});
  return {116 * v[1] - 16, 500 * (v[0] - v[1]), 200 * (v[1] - v[2])};
}

Colour to_hunt_lab(const Colour& c) {
  Colour v = xyz_over_white(c);
  for (double& x : v) x = x > std::pow(6. / 29, 3) ? std::cbrt(x) : 841. / 108 * x + 4. / 29;
  const double lightness = 116 * v[1] - 16;
  return {lightness, 0.01 * lightness * 500 * (v[0] - v[1]), 0.01 * lightness * 200 * (v[1] - v[2])};
}

Colour to_rgb(const Colour& v) {
  const double y = (v[0] + 16) / 116, x = (y + v[1] / 500) * 0.950428545, z = (y - v[2] / 200) * 1.088900371;
  Colour c = {3.2410033 * x - 1.5373990 * y - 0.4986159 * z, -0.9692243 * x + 1.8759300 * y + 0.0415542 * z,
              0.0556394 * x - 0.2040112 * y + 1.0571490 * z};
  for (double& part : c) part = std::min(std::max(part, 0.), 1.);
  return c;
}

double hyab(const Colour& a, const Colour& b) {
  return std::pow(std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}

/// Sum of weight(dx, dy) times value(x + dx, y + dy), the image's edge repeated.
template <class Weight, class Value>
double convolved(const Image& image, int x, int y, int radius, const Weight& weight, const Value& value) {
  double sum = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx)
      sum += weight(dx, dy) * value(image.at(std::min(std::max(x + dx, 0), image.width - 1),
                                             std::min(std::max(y + dy, 0), image.height - 1)));
  return sum;
}

double total_of(int radius, const std::function<double(int, int)>& weight) {
  double sum = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) sum += weight(dx, dy);
  return sum;
}

Colour colour_seen(const Image& image, int x, int y) {
  constexpr double kBands[3][4] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * kPixelsPerDegree));
  Colour result{};
  for (std::size_t band = 0; band < 3; ++band) {
    const double a1 = kBands[band][0], b1 = kBands[band][1], a2 = kBands[band][2], b2 = kBands[band][3];
    const auto weight = [=](int dx, int dy) {
      const double r2 = (dx * dx + dy * dy) / (kPixelsPerDegree * kPixelsPerDegree);
      return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * r2 / b1) +
             a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * r2 / b2);
    };
    result[band] = convolved(image, x, y, radius, weight, [&](const Rgb& c) { return to_ycxcz(c)[band]; }) /
                   total_of(radius, weight);
  }
  return to_hunt_lab(to_rgb(result));
}

/// The length of the lightness's first or second derivative.
double feature_seen(const Image& image, int x, int y, bool edge) {
  const double sd = 0.041 * kPixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sd));
  const auto raw = [=](int dx, int dy) {
    const double g = std::exp(-(dx * dx + dy * dy) / (2 * sd * sd));
    return edge ? -dx * g : (dx * dx / (sd * sd) - 1) * g;
  };
  const double positive = total_of(radius, [&](int dx, int dy) { return std::max(raw(dx, dy), 0.); }),
               negative = -total_of(radius, [&](int dx, int dy) { return std::min(raw(dx, dy), 0.); });
  const auto weight = [&](int dx, int dy) { return raw(dx, dy) / (raw(dx, dy) > 0 ? positive : negative); };
  const auto lightness = [](const Rgb& c) { return (to_ycxcz(c)[0] + 16) / 116; };
  return std::hypot(convolved(image, x, y, radius, weight, lightness),
                    convolved(
                        image, x, y, radius, [&](int dx, int dy) { return weight(dy, dx); }, lightness));
}

double slow_flip(const Image& a, const Image& b, int x, int y) {
  const double most = hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1}));
  const double d = hyab(colour_seen(a, x, y), colour_seen(b, x, y));
  const double colour = d < 0.4 * most ? 0.95 * d / (0.4 * most) : 0.95 + 0.05 * (d - 0.4 * most) / (0.6 * most);
  const double feature = std::max(std::abs(feature_seen(a, x, y, true) - feature_seen(b, x, y, true)),
                                  std::abs(feature_seen(a, x, y, false) - feature_seen(b, x, y, false)));
  return std::pow(colour, 1 - std::sqrt(feature / std::sqrt(2)));
}

TEST(Flip, AgreesWithThePaper) {
  const Image a = random_image(14, 11, 1);
  Image b = random_image(14, 11, 2);
  for (std::size_t i = 0; i < b.pixels.size(); i += 2) b.pixels[i] = a.pixels[i];
  const std::vector<float> errors = flip(a, b, kPixelsPerDegree);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 14; ++x) EXPECT_NEAR(errors[a.index(x, y)], slow_flip(a, b, x, y), 1e-4) << x << ", " << y;
}

TEST(Flip, EqualImagesDoNotDiffer) {
  const Image a = random_image(9, 9, 3);
  for (const float error : flip(a, a)) EXPECT_EQ(error, 0);
}

/// Flat images have no features: only the distance of the colours remains, which is that of black and white, and the
/// largest for green and blue.
TEST(Flip, FlatColoursHaveTheirDistance) {
  const auto flat = [](const Rgb& colour) {
    Image image(30, 30);
    for (Rgb& pixel : image.pixels) pixel = colour;
    return image;
  };
  const double most = hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1}));
  EXPECT_NEAR(flip(flat({0, 1, 0}), flat({0, 0, 1}))[400], 1, 1e-3);
  const double black_and_white = std::pow(100, 0.7);
  EXPECT_NEAR(flip(flat(Rgb(0)), flat(Rgb(1)))[400], 0.95 + 0.05 * (black_and_white - 0.4 * most) / (0.6 * most), 1e-3);
}

}  // namespace flip_test
}  // namespace dspm
