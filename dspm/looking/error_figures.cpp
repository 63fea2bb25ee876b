#include "dspm/looking/error_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/colour/rgb.h"

namespace dspm {

ErrorFigures error_figures(const Image& reference, const Image& test) {
  if (reference.width != test.width || reference.height != test.height)
    throw std::runtime_error(fmt::format("{} x {} and {} x {} pixels cannot be compared", reference.width,
                                         reference.height, test.width, test.height));
  const double count = 3. * static_cast<double>(reference.pixels.size());
  double mean = 0;
  for (const Rgb& pixel : reference.pixels)
    for (int c = 0; c < 3; ++c) mean += static_cast<double>(pixel[c]) / count;
  const double least = std::max(std::abs(mean) / 100, 1e-30);
  ErrorFigures figures;
  double squares = 0, relative = 0, sum = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto a = static_cast<double>(reference.pixels[i][c]), error = static_cast<double>(test.pixels[i][c]) - a;
      squares += error * error, sum += error;
      relative += std::pow(error / std::max(std::abs(a), least), 2);
      if (!(std::abs(error) > figures.largest)) continue;
      figures.largest = std::abs(error);
      figures.x = static_cast<int>(i) % reference.width, figures.y = static_cast<int>(i) / reference.width;
    }
  figures.rmse = std::sqrt(squares / count);
  figures.relative_rmse = std::sqrt(relative / count);
  figures.bias = mean == 0 ? 0 : sum / count / mean;
  return figures;
}

}  // namespace dspm
