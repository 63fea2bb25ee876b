// What dspm promises of every integrator, to the bit: images depend neither on the number of threads nor on whether the
// render was interrupted. What is the same in every pixel shows neither: give a scene with edges.
#pragma once

#include <string>

#include "dspm/testing/verdict.h"

namespace dspm::test {

/// All frames of a scene's text are the same with one, two and five threads.
Verdict check_threads(const std::string& scene, int iterations = 3);

/// An integrator that takes over the state of another one, after any of its iterations, ends in the same images.
Verdict check_resume(const std::string& scene, int iterations = 3);

}  // namespace dspm::test
