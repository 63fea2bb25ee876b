// Chooses which outputs a run writes next to radiance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/image/film/film.h"
#include "dspm/integrators/output_info.h"
#include "dspm/lang/description.h"
#include "dspm/session/job/choices.h"

namespace dspm {

/// Returns the Film's outputs, then the chosen ones. Names that stand for several outputs ("lights", "cryptoobject")
/// become them.
std::vector<std::string> outputs_of(const FilmSettings& film, const Choices& choices,
                                    const SceneDescription& description);
/// Appends the outputs that the denoiser takes, if there is one.
std::vector<std::string> with_denoiser_inputs(std::vector<std::string> outputs, std::optional<Denoiser> denoiser);
/// The outputs of all light groups that the text names, in the order of Scene::light_groups.
std::vector<std::string> light_group_outputs(const SceneDescription& description);

/// PNG and WebP hold the alpha of a transparent film, EXR all outputs, the others none. Throws UsageError.
void expect_room(const FilmSettings& film, const std::vector<std::string>& outputs,
                 const SceneDescription& description);

/// Reports an error if what an integrator declares does not suit a file.
void check_outputs(const std::vector<OutputInfo>& declared, const std::vector<std::string>& asked,
                   const std::string& integrator, Diagnostics& diagnostics);

}  // namespace dspm
