// Lens files, as pbrt reads them: four numbers for each surface, from the scene to the film. They are its radius (0: a
// stop), the thickness of what follows it and the index of that, and the diameter of its aperture; lengths are in mm,
// and # begins a comment. The last thickness is replaced when the lens is focused.
#pragma once

#include <string_view>
#include <vector>

#include "dspm/cameras/lens_system.h"

namespace dspm {

/// Returns at least one surface. Throws std::runtime_error with a sentence that does not name the file.
std::vector<LensSurface> parse_lens(std::string_view text);

}  // namespace dspm
