// The light that is left after a way through matter that is the same everywhere.
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"

namespace dspm {

/// Returns exp(-sigma_t distance), of a distance that may be infinite.
constexpr Spectrum left_after(const Spectrum& sigma_t, float distance) {
  Spectrum left;
  for (int c = 0; c < 3; ++c) left[c] = sigma_t[c] > 0 ? rounded::exp(-sigma_t[c] * distance) : 1;
  return left;
}

}  // namespace dspm
