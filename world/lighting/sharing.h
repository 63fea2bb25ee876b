// Explains what frames share and what they do not, and why, for --explain.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/cameras/camera.h"
#include "dspm/lang/description.h"
#include "dspm/world/lighting/light_choices.h"
#include "dspm/world/lighting/lighting.h"
#include "dspm/world/lighting/photon_worth.h"
#include "dspm/world/objects/geometry.h"

namespace dspm {

/// Explains the scene of these frames of the file, one sentence per line.
std::vector<std::string> explain_sharing(const SceneDescription& description, const Geometry& geometry,
                                         const Looks& looks, const std::vector<WorldLight>& lights,
                                         const Timeline<std::shared_ptr<const Camera>>& camera,
                                         std::span<const FileFrame> frames);

/// Explains which frames choose lights for their photons on their own; and, if photons are worth less to some of these
/// frames than in files of their own, how much less, and why.
std::vector<std::string> explain_worth(const FileFrames& file, const LightChoices& choices,
                                       const std::vector<PhotonWorth>& worth, std::span<const FileFrame> frames);

}  // namespace dspm
