// Overlaps of bodies in a user's words.
#pragma once

#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/lang/file_frames.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/looks.h"
#include "dspm/world/overlaps.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Warns once for each pair of materials, or of directives with one material, but only a few times. `shapes` are those
/// of the scene.
void warn_of(const std::vector<Overlap>& overlaps, const Scene& bodies, const std::vector<const WorldShape*>& shapes,
             const Looks& looks, const FileFrames& frames, Diagnostics& diagnostics);

}  // namespace dspm
