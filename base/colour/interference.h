// The colours of interference: waves that have run different ways add up by their phases, which depend on wavelength.
#pragma once

#include "dspm/base/colour/rgb.h"

namespace dspm {

/// The colour under daylight of a spectrum that is the cosine of the phase by which a path longer by so many nm delays
/// each wavelength: white (1, 1, 1) at 0, between -1.6 and 1.6, and black from 20 micrometres on. [Belcour and Barla
/// 2017, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence, 4]
Rgb interference(float path_nm);

}  // namespace dspm
