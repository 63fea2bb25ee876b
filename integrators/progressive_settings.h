// The parameters that dsppm and sppm have in common, read in one place.
#pragma once

#include "integrators/estimator.h"
#include "integrators/photon.h"

namespace dspm {

struct ProgressiveSettings {
  int iterations = 256;  // 0: until stopped
  int photons = 300000;  // paths an iteration, in each frame
  float alpha = 0.7f;
  bool kz11 = false;
  PhotonSettings photon;
  HitPointSettings hit_point;
};

/// Reads them and calls finish(). An integrator that knows but one estimator does not let the scene choose it.
ProgressiveSettings read_progressive_settings(ParamReader& params, const RenderSettings& render, bool choose_estimator);

}  // namespace dspm
