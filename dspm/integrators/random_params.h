// Parameters that all integrators have. The job reads them before it makes one; here they are only known by name.
#pragma once

#include "dspm/params/params.h"

namespace dspm {

inline void describe_random_numbers(ParamReader& params) {
  params.integer("seed", 0, "", "seed of the random numbers; the command line takes precedence");
  params.choice("noise", "frozen", {"frozen", "perframe"},
                "frozen: all frames share their noise; perframe: those in which the camera has moved have noise of "
                "their own; the command line takes precedence");
}

}  // namespace dspm
