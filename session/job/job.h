// A job says what to render, and how: the scene's Film, PixelFilter, Sampler and Integrator, overridden by the caller's
// choices.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/params/params.h"
#include "dspm/image/film/film.h"
#include "dspm/integrators/integrator.h"
#include "dspm/lang/description.h"
#include "dspm/lang/shutter.h"
#include "dspm/session/job/choices.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The pixel filter of scenes that name none.
inline constexpr const char* kUsualPixelFilter = "gaussian";

struct Job {
  std::string scene_file;
  const SceneDescription* description = nullptr;  // outlives the job
  std::vector<FileFrame> frames;                  // ascending
  std::optional<KnownFrames> known;               // of the run that is resumed
  bool numbered = false;                          // image names contain the frame's number
  double fps = 0;                                 // 0: no animation
  Shutter shutter;                                // without delays if nothing can move
  int moments = 1;                                // of the shutter that an iteration shows, see session/exposure.h
  FilmSettings film;
  float exposure = 1;                // image values over radiance
  std::vector<std::string> outputs;  // to be written next to radiance
  std::optional<Denoiser> denoiser;
  RenderSettings settings;  // its outputs: those, and what the denoiser takes
  std::string integrator;
  const IntegratorPlugin* plugin = nullptr;
  ParamList params;      // of the integrator
  SourceLocation where;  // of the Integrator directive
  /// A variation's own settings for the integrator.
  struct OwnIntegrator {
    const PluginUse* use;
    ParamList params;
  };
  std::vector<OwnIntegrator> own_integrators;
  std::string accel;  // a plugin's name; empty: the usual one
  std::optional<int> chosen_iterations;
  bool quick = false;      // a quarter of the iterations
  double until_error = 0;  // ends the render, see error_estimate.h; 0: iterations do

  /// The frame's moment. variation() is the name of its variation, empty if there is none.
  Moment moment(FileFrame frame) const { return description->frames.moment(frame); }
  const std::string& variation(FileFrame frame) const { return description->frames.variation(frame); }
  /// Returns "25 frames", "8 variations" or "200 frames (8 variations)".
  std::string frames_in_words() const;

  /// Returns how many iterations to do in all: as chosen; else 0 (until stopped) if an error is to be reached; else as
  /// many as the integrator says.
  int iterations(const Integrator& made) const;
};

/// Reports errors to `diagnostics`. Throws UsageError if the command line does not fit this scene.
Job make_job(const SceneDescription& description, const Choices& choices, Diagnostics& diagnostics);

}  // namespace dspm
