// Parameters that all integrators have.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/integrators/integrator.h"

namespace dspm {

inline const std::vector<std::string> kNoises = {"frozen", "perframe"};  // the default is the first

/// Reads "iterations", which are so many of `what`: "paths per pixel".
inline int read_iterations(ParamReader& params, const RenderSettings& render, const std::string& what) {
  const int iterations =
      params.integer("iterations", render.default_iterations, "",
                     what + "; 0: until stopped. The default is the sampler's pixelsamples, else 256");
  if (iterations < 0) params.error("iterations", "the number of iterations must not be negative");
  return iterations;
}

/// Reads what decides random numbers, for its description only: the job reads it before it makes an integrator.
inline void describe_random_numbers(ParamReader& params) {
  params.integer("seed", 0, "", "seed of the random numbers; the command line takes precedence");
  params.choice("noise", kNoises.front(), kNoises,
                "frozen: all frames share their noise; perframe: those in which the camera has moved have noise of "
                "their own; the command line takes precedence");
}

}  // namespace dspm
