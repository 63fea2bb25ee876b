#include "dspm/looking/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dspm/base/colour/rgb.h"

namespace dspm {
namespace {

/// A plane of numbers that continues outside as its edge.
struct Plane {
  int width, height;
  std::vector<float> values;

  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float at(int x, int y) const {
    x = std::clamp(x, 0, width - 1), y = std::clamp(y, 0, height - 1);
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Weights from -radius to radius.
using Kernel = std::vector<double>;

template <class Weight>
Kernel kernel(int radius, const Weight& weight) {
  Kernel values;
  for (int x = -radius; x <= radius; ++x) values.push_back(weight(static_cast<double>(x)));
  return values;
}

double sum(const Kernel& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// Filters along the rows by one kernel, then along the columns by the other.
Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down) {
  const auto along = [](const Plane& from, const Kernel& weights, int dx, int dy) {
    const int radius = static_cast<int>(weights.size()) / 2;
    Plane to(from.width, from.height);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        double total = 0;
        for (int i = -radius; i <= radius; ++i)
          total += weights[static_cast<std::size_t>(i + radius)] * static_cast<double>(from.at(x + i * dx, y + i * dy));
        to.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(from.width) + static_cast<std::size_t>(x)] =
            static_cast<float>(total);
      }
    return to;
  };
  return along(along(plane, across, 1, 0), down, 0, 1);
}

// --- Colours. D65's white, and the matrix between linear sRGB and XYZ. [IEC 61966-2-1]
using Triple = std::array<double, 3>;
constexpr Triple kWhite = {0.950428545, 1, 1.088900371};
constexpr double kToXyz[3][3] = {
    {0.4123863, 0.3575915, 0.1804505}, {0.2126368, 0.7151830, 0.0721802}, {0.0193306, 0.1191972, 0.9503726}};
constexpr double kToRgb[3][3] = {
    {3.2410033, -1.5373990, -0.4986159}, {-0.9692243, 1.8759300, 0.0415542}, {0.0556394, -0.2040112, 1.0571490}};

Triple times(const double (&m)[3][3], const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

/// Converts XYZ over white's to lightness and two opponents; CIELAB does it to their cube roots.
Triple opponents(const Triple& v) { return {116 * v[1] - 16, 500 * (v[0] - v[1]), 200 * (v[1] - v[2])}; }

Triple ycxcz(const Triple& rgb) {
  Triple xyz = times(kToXyz, rgb);
  for (std::size_t i = 0; i < 3; ++i) xyz[i] /= kWhite[i];
  return opponents(xyz);
}

Triple rgb_of_ycxcz(const Triple& v) {
  const double y = (v[0] + 16) / 116;
  return times(kToRgb, {(y + v[1] / 500) * kWhite[0], y * kWhite[1], (y - v[2] / 200) * kWhite[2]});
}

/// Converts to CIELAB, with opponents that fade in the dark. [Hunt's effect; section 4.1]
Triple hunt_lab(const Triple& rgb) {
  constexpr double kKnee = 6. / 29;
  Triple xyz = times(kToXyz, rgb);
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = xyz[i] / kWhite[i];
    xyz[i] = v > kKnee * kKnee * kKnee ? std::cbrt(v) : v / (3 * kKnee * kKnee) + 4. / 29;
  }
  Triple lab = opponents(xyz);
  lab[1] *= 0.01 * lab[0], lab[2] *= 0.01 * lab[0];
  return lab;
}

/// Returns the distance HyAB to the power 0.7.
double distance(const Triple& a, const Triple& b) {
  return std::pow(std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}

/// Maps distances to 0..1: the lower 0.4 of their range takes 0.95 of it.
double redistributed(double d) {
  static const double most = distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
  constexpr double kShare = 0.4, kTarget = 0.95;
  const double knee = kShare * most;
  return d < knee ? kTarget * d / knee : kTarget + (d - knee) / (most - knee) * (1 - kTarget);
}

// --- What the eye blurs: a sum of Gaussians for each opponent, in degrees. [Table 1]
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivities[] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
constexpr double kWidest = 0.04;

Plane blurred(const Plane& plane, const Sensitivity& s, double pixels_per_degree) {
  using std::numbers::pi;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * pi * pi)) * pixels_per_degree));
  const auto gaussian = [&](double b) {
    return kernel(radius,
                  [&](double x) { return std::exp(-pi * pi * x * x / (b * pixels_per_degree * pixels_per_degree)); });
  };
  const Kernel g1 = gaussian(s.b1), g2 = gaussian(s.b2);
  const double w1 = s.a1 * std::sqrt(pi / s.b1), w2 = s.a2 * std::sqrt(pi / s.b2);
  const double total = w1 * sum(g1) * sum(g1) + w2 * sum(g2) * sum(g2);
  Plane result = filtered(plane, g1, g1);
  for (float& value : result.values) value *= static_cast<float>(w1 / total);
  if (w2 == 0) return result;
  const Plane second = filtered(plane, g2, g2);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] += static_cast<float>(w2 / total) * second.values[i];
  return result;
}

// --- What catches the eye: edges and points of the lightness. [Section 4.2]
struct Features {
  std::vector<float> edges, points;
};

/// Scales the positive weights to add up to 1, and the negative ones to -1, after the kernel across them, which adds up
/// to `total`.
Kernel balanced(Kernel weights, double total) {
  double positive = 0, negative = 0;
  for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w) * total;
  for (double& w : weights) w /= w > 0 ? positive : negative;
  return weights;
}

std::vector<float> lengths(const Plane& plane, const Kernel& derivative, const Kernel& smooth) {
  const Plane x = filtered(plane, derivative, smooth), y = filtered(plane, smooth, derivative);
  std::vector<float> result;
  for (std::size_t i = 0; i < x.values.size(); ++i)
    result.push_back(std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]));
  return result;
}

Features features_of(const Plane& lightness, double pixels_per_degree) {
  constexpr double kWidth = 0.082;  // degrees from peak to trough
  const double sd = kWidth / 2 * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sd));
  const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * sd * sd)); };
  const Kernel smooth = kernel(radius, gaussian);
  const auto sized = [&](const Kernel& weights) { return balanced(weights, sum(smooth)); };
  return {lengths(lightness, sized(kernel(radius, [&](double x) { return -x * gaussian(x); })), smooth),
          lengths(lightness, sized(kernel(radius, [&](double x) { return (x * x / (sd * sd) - 1) * gaussian(x); })),
                  smooth)};
}

/// An image as FLIP sees it.
struct Seen {
  std::vector<Triple> colours;
  Features features;
};

Seen seen(const Image& image, double pixels_per_degree) {
  std::vector<Plane> planes(3, Plane(image.width, image.height));
  Plane lightness(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Rgb& c = image.pixels[i];
    const Triple v = ycxcz({static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)});
    for (std::size_t k = 0; k < 3; ++k) planes[k].values[i] = static_cast<float>(v[k]);
    lightness.values[i] = static_cast<float>((v[0] + 16) / 116);
  }
  for (std::size_t k = 0; k < 3; ++k) planes[k] = blurred(planes[k], kSensitivities[k], pixels_per_degree);
  Seen result{std::vector<Triple>(image.pixels.size()), features_of(lightness, pixels_per_degree)};
  for (std::size_t i = 0; i < result.colours.size(); ++i) {
    Triple rgb = rgb_of_ycxcz({static_cast<double>(planes[0].values[i]), static_cast<double>(planes[1].values[i]),
                               static_cast<double>(planes[2].values[i])});
    for (double& v : rgb) v = std::clamp(v, 0., 1.);
    result.colours[i] = hunt_lab(rgb);
  }
  return result;
}

}  // namespace

std::vector<float> flip(const Image& reference, const Image& test, double pixels_per_degree) {
  const Seen a = seen(reference, pixels_per_degree), b = seen(test, pixels_per_degree);
  std::vector<float> errors;
  for (std::size_t i = 0; i < a.colours.size(); ++i) {
    const double colour = redistributed(distance(a.colours[i], b.colours[i]));
    const float feature = std::max(std::abs(a.features.edges[i] - b.features.edges[i]),
                                   std::abs(a.features.points[i] - b.features.points[i]));
    errors.push_back(
        static_cast<float>(std::pow(colour, 1 - std::sqrt(static_cast<double>(feature) / std::numbers::sqrt2))));
  }
  return errors;
}

}  // namespace dspm
