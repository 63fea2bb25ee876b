// Integrator "dsppm" "integer iterations" 400 "integer photons" 300000
//
// Dynamic stochastic progressive photon mapping [WG12]: all frames together. Camera and photon paths that meet only
// objects common to all frames are traced once, and hit points shared by frames gather once; every frame converges to
// the result of sppm for that frame alone. Parameters: see progressive_settings.cpp.
#include "dspm/integrators/methods/dsppm/dsppm.h"

#include "dspm/base/params/params.h"
#include "dspm/integrators/methods/progressive.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

std::unique_ptr<Integrator> make_dsppm(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  ProgressiveSettings settings = read_progressive_settings(params, render);
  expect_photons_in_media(params, settings, scene);
  choose_device(params, settings, scene, render);
  return make_progressive(settings, scene, render, settings.kz11 ? shared_kz11() : shared_hj09());
}

}  // namespace dspm
