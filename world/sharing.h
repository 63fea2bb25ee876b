// What frames share and what they do not, and why, in words: for --explain.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lang/description.h"
#include "world/geometry.h"
#include "world/lighting.h"

namespace dspm {

/// A sentence a line about the scene of these frames of the file.
std::vector<std::string> explain_sharing(const SceneDescription& description, const Geometry& geometry, const Looks& looks,
                                         const std::vector<WorldLight>& lights, std::size_t camera_states,
                                         std::span<const Frame> frames);

}  // namespace dspm
