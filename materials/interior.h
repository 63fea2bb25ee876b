// The medium that fills a body: it absorbs and scatters light on its way from one point of the surface to another.
#pragma once

#include "dspm/base/colour/spectrum.h"

namespace dspm {

/// The coefficients of a body by colour; all are 0 outside of bodies.
struct Interior {
  Spectrum sigma_t;       // light that is absorbed or scattered, per unit of length
  Spectrum albedo;        // the share of it that is scattered
  float g = 0;            // the mean cosine of scattering [Henyey and Greenstein 1941]
  float thrown_back = 0;  // the share of light that the surface throws back into the body, in all directions

  constexpr bool is_empty() const { return is_black(sigma_t) && thrown_back == 0; }
  friend constexpr bool operator==(const Interior&, const Interior&) = default;
};

}  // namespace dspm
