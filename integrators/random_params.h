// Parameters that all integrators have. The job reads them before it makes one; here they are only known by name.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/params/params.h"

namespace dspm {

inline const std::vector<std::string> kNoises = {"frozen", "perframe"};  // the default is the first

inline void describe_random_numbers(ParamReader& params) {
  params.integer("seed", 0, "", "seed of the random numbers; the command line takes precedence");
  params.choice("noise", kNoises.front(), kNoises,
                "frozen: all frames share their noise; perframe: those in which the camera has moved have noise of "
                "their own; the command line takes precedence");
}

}  // namespace dspm
