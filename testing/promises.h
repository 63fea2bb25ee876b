// dspm's promises for every integrator: images depend neither on the number of threads nor on whether the render was
// interrupted, nor on which other frames and pixels are rendered. An image that is the same in every pixel shows none
// of this: give a scene with edges.
#pragma once

#include <string>

#include "dspm/testing/verdict.h"

namespace dspm::test {

/// Checks that all frames of a scene's text have the same bits with one, two and five threads.
Verdict check_threads(const std::string& scene, int iterations = 3);

/// Checks that an integrator that takes over the state of another one, after any of its iterations, ends with the same
/// images.
Verdict check_resume(const std::string& scene, int iterations = 3);

/// Checks that each frame of a joint render is that of a render of it alone, up to rounding (1e-5 of a pixel, or of
/// 0.001 if it is darker). Give an animation.
Verdict check_joint(const std::string& scene, int iterations = 3);

/// Checks that the pixels of a crop are those of the whole image, up to rounding.
Verdict check_crop(const std::string& scene, int iterations = 3);

}  // namespace dspm::test
