// The error of an integrator's images, estimated while it iterates, from the images alone: so it works for every
// integrator, plugins included.
//
// After N iterations the image is the mean E_N of N independent ones, so E_N - E_N/2 = (B - A) / 2, where A and B are
// the means of the two halves. Every iteration has the weight 1/N in it, half of them with a minus: its variance is
// that of E_N, however the iterations' variances differ. Its values scatter around zero as those of E_N do around their
// mean. Hence the median over pixels of |E_N - E_N/2| / E_N estimates that of the true relative error: half of the
// pixels are farther off. It does not see what both halves have in common: the blur of the photons' radius, or
// photonmap's photons, which are the same in all iterations.
//
// A median knows nothing of the few pixels where one path outweighs all others. Such a path adds the same to E_N,
// divided by N, whenever it came; so one that makes a pixel more than twice as bright as all others together changes it
// by more than half between E_N/2 and E_N. If it came in the second half it was not there before, and if it came in the
// first it was twice as strong.
#pragma once

#include <memory>
#include <string_view>

#include "dspm/image/film/pixel_rect.h"
#include "dspm/integrators/beside/make_beside.h"
#include "dspm/integrators/integrator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The counter of Statistics::counters that holds the number of parts of the picture, at most 1024, whose brightest
/// pixel changed by more than half since half of the iterations, by far more than is usual in that image, and against
/// its surroundings; in the frame with most.
inline constexpr std::string_view kLonePaths = "lone paths";

/// Returns the integrator that `make` returns (null if it failed), whose statistics then have the errors of the
/// luminance of all frames. They are estimated 2, 4 or 8 times until the number of iterations has doubled, as after 8,
/// 12, 16, 24, ..., if the image after half of them was seen: an iterate() that does several iterations passes over
/// some. In between they stay, and so do kLonePaths, which are not counted if there are none. Constant light needs no
/// iterations, so pixels that show it are left out, as are black ones; a black frame has no error. Parts estimate their
/// own errors, and these add up as independent ones do. Keeps at most 160 KB per frame of images over `crop`. `memory`
/// is the bound in bytes for both; 0 means none. Throws NotEnoughMemory.
std::unique_ptr<Integrator> with_error_estimate(const MakeWithin& make, const Scene& scene, const PixelRect& crop,
                                                int marks_per_octave, std::size_t memory);

}  // namespace dspm
