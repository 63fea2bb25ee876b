// Turns radiance into the values in files.
#pragma once

#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/job/job.h"

namespace dspm {

/// Exposes and balances the image as the film says, but without its limits.
Image exposed(Image image, const Job& job);
/// Exposes and balances the image, with the film's limit. Colours outside Rec. 709 are clamped to it.
Image developed(Image image, const Job& job);

/// What views show: `radiance` developed, with this alpha, an output of the integrator.
Image with_alpha(Image radiance, const Image& alpha, const Job& job);
/// The same of a frame, without alpha if the film is not transparent.
Image to_be_shown(const Integrator& integrator, Frame frame, const Job& job);

}  // namespace dspm
