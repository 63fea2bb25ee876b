// How far an image is from a reference, in numbers.
#pragma once

#include <string>

#include "dspm/image/image.h"

namespace dspm {

/// Over all components of all pixels, of the linear values.
struct ErrorFigures {
  double rmse = 0;           // root of the mean squared error
  double relative_rmse = 0;  // errors over the reference's values, which count as a hundredth of their mean at least
  double bias = 0;           // the mean error over the mean
  double largest = 0;        // absolute error
  int x = 0, y = 0;          // where that is
};

/// Throws std::runtime_error if the sizes differ.
ErrorFigures error_figures(const Image& reference, const Image& test);

}  // namespace dspm
