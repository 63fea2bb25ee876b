#include "dspm/looking/error_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"

namespace dspm {
namespace {

/// Compares opacities; an image without alpha is opaque.
double alpha_rmse(const Image& reference, const Image& test) {
  double squares = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    const auto of = [&](const Image& image) { return image.alpha.empty() ? 1. : static_cast<double>(image.alpha[i]); };
    squares += std::pow(of(test) - of(reference), 2);
  }
  return std::sqrt(squares / static_cast<double>(reference.pixels.size()));
}

}  // namespace

ErrorFigures error_figures(const Image& reference, const Image& test) {
  if (reference.width != test.width || reference.height != test.height)
    throw std::runtime_error(fmt::format("{} x {} and {} x {} pixels cannot be compared", reference.width,
                                         reference.height, test.width, test.height));
  const auto counts = [&](std::size_t i) { return is_finite(reference.pixels[i]) && is_finite(test.pixels[i]); };
  double count = 0, mean = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i)
    if (counts(i))
      for (int c = 0; c < 3; ++c) ++count, mean += static_cast<double>(reference.pixels[i][c]);
  ErrorFigures figures;
  figures.left_out = reference.pixels.size() - static_cast<std::size_t>(count / 3);
  if (!reference.alpha.empty() || !test.alpha.empty()) figures.alpha_rmse = alpha_rmse(reference, test);
  if (count == 0) return figures;
  mean /= count;
  const double least = std::abs(mean) / 100;
  double squares = 0, relative = 0, sum = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i)
    for (int c = 0; c < 3 && counts(i); ++c) {
      const auto a = static_cast<double>(reference.pixels[i][c]), error = static_cast<double>(test.pixels[i][c]) - a;
      squares += error * error, sum += error;
      if (mean != 0) relative += std::pow(error / std::max(std::abs(a), least), 2);
      if (!(std::abs(error) > figures.largest)) continue;
      figures.largest = std::abs(error);
      figures.x = static_cast<int>(i) % reference.width, figures.y = static_cast<int>(i) / reference.width;
    }
  figures.rmse = std::sqrt(squares / count);
  if (mean != 0) figures.relative_rmse = std::sqrt(relative / count), figures.bias = sum / count / mean;
  return figures;
}

}  // namespace dspm
