// The light that is left after a way through matter that is the same everywhere.
#pragma once

#include <cmath>

#include "dspm/base/colour/spectrum.h"

namespace dspm {

/// Returns exp(-sigma_t distance), of a distance that may be infinite.
inline Spectrum left_after(const Spectrum& sigma_t, float distance) {
  Spectrum left;
  for (int c = 0; c < 3; ++c) left[c] = sigma_t[c] > 0 ? std::exp(-sigma_t[c] * distance) : 1;
  return left;
}

}  // namespace dspm
