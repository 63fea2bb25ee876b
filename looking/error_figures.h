// Measures how far an image is from a reference.
#pragma once

#include <optional>
#include <string>

#include "dspm/image/image.h"

namespace dspm {

/// Figures over all components of the linear values of all pixels that are finite in both images.
struct ErrorFigures {
  double rmse = 0;  // root of the mean squared error
  // Errors over the reference's values, which count as a hundredth of their mean at least. Of a black reference: none.
  std::optional<double> relative_rmse;
  std::optional<double> bias;        // the mean error over the mean, likewise
  double largest = 0;                // absolute error
  int x = 0, y = 0;                  // where that is
  std::optional<double> alpha_rmse;  // if one of the images has an alpha
  std::size_t left_out = 0;          // pixels that are not finite
};

/// Throws std::runtime_error if the sizes differ.
ErrorFigures error_figures(const Image& reference, const Image& test);

}  // namespace dspm
