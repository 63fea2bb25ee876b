// What frames share and what they do not, and why, in words: for --explain.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cameras/camera.h"
#include "lang/description.h"
#include "world/geometry.h"
#include "world/lighting.h"

namespace dspm {

/// A sentence a line about the scene of these frames of the file.
std::vector<std::string> explain_sharing(const SceneDescription& description, const Geometry& geometry,
                                         const Looks& looks, const std::vector<WorldLight>& lights,
                                         const Timeline<std::shared_ptr<const Camera>>& camera,
                                         std::span<const Frame> frames);

}  // namespace dspm
