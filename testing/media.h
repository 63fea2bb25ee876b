// Checks of a medium: its properties, bounds and extent agree, and light passes it as quadrature says. Random numbers are
// fixed: a pass stays a pass.
#pragma once

#include <memory>
#include <string>

#include "dspm/media/medium.h"
#include "dspm/testing/verdict.h"

namespace dspm::test {

/// Returns the medium that a scene gets for these words, `"homogeneous" "float scale" 2`, after the transforms `place`.
/// Throws SceneError for a mistake in them.
std::shared_ptr<const Medium> medium_of(const std::string& words, const std::string& place = "");

/// Checks that coefficients are finite and not negative, and mean cosines between -1 and 1.
Verdict is_sound(const Medium& medium);
/// Checks that no point of a box is denser than the box's majorant, and that there is nothing outside of the extent.
Verdict keeps_to_bounds(const Medium& medium);
/// Checks what is left of light along lines, estimated by tentative collisions, against quadrature of sigma_t.
Verdict lets_light_through(const Medium& medium);

/// Runs all of these checks.
Verdict check_medium(const std::string& words, const std::string& place = "");

}  // namespace dspm::test
