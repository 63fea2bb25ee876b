// Furnaces: scenes whose light is so even that the answer is known.
#pragma once

#include <string>

#include "dspm/testing/agreement.h"
#include "dspm/testing/verdict.h"

namespace dspm::test {

/// Checks that an integrator of full light transport finds 1 / (1 - albedo) in the closed furnace (see scenes.h), for
/// several albedos. It must follow paths over some 40 surfaces: 0.8^40 is 0.013%.
Verdict check_furnace(const std::string& integrator, int iterations, const Tolerance& tolerance = {});

/// Checks that the open furnace shows the albedo of the samples of the material's Bsdf, however much light it
/// transmits.
Verdict check_open_furnace(const std::string& material, const std::string& integrator = "\"path\"", int iterations = 16,
                           const Tolerance& tolerance = {});

}  // namespace dspm::test
