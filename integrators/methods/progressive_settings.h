// The parameters that dsppm and sppm share.
#pragma once

#include <cstdint>

#include "dspm/base/params/params.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct ProgressiveSettings {
  int iterations = 256;     // 0: until stopped
  int photons = 300000;     // paths per iteration, in each frame
  std::int64_t traced = 0;  // of these; the others are made up for by their flux, or bring nothing
  float alpha = 0.7f;
  bool kz11 = true;        // the estimator; else hj09
  bool guided = true;      // photons start where they are found; else by the lights' power
  bool may_choose = true;  // how much of the light photons bring, by what pays
  PhotonSettings photon;
  HitPointSettings hit_point;
  Device device = Device::cpu;  // not automatic
  std::string why_not_gpu;      // if a GPU would have been taken
};

/// Returns the settings in words, for the log.
std::string in_words(const ProgressiveSettings& settings);

/// Reports an error if camera paths are to find what media scatter.
void expect_photons_in_media(ParamReader& params, const ProgressiveSettings& settings, const Scene& scene);

/// Sets the device; reports an error if photons cannot be traced on the one that was asked for.
void choose_device(ParamReader& params, ProgressiveSettings& settings, const Scene& scene, const RenderSettings& render);

/// Reads the parameters and calls finish().
ProgressiveSettings read_progressive_settings(ParamReader& params, const RenderSettings& render);

}  // namespace dspm
