// The table of integrators: one line for each.
#include "dspm/base/math/frames.h"
#include "dspm/integrators/integrator.h"

namespace dspm {

MakeIntegrator make_ambientocclusion, make_dsppm, make_path, make_photonmap, make_sppm, make_vcm;

PluginTable<IntegratorPlugin>& integrator_plugins() {
  static PluginTable<IntegratorPlugin> table(
      "integrator",
      {
          {{"ambientocclusion", "how much of the sky the first surface sees", make_ambientocclusion},
           kMaxFrames,
           false,
           true},
          {{"dsppm", "dynamic stochastic progressive photon mapping: all frames together", make_dsppm},
           kMaxFrames,
           true,
           true,
           true},
          {{"path", "path tracing, the unbiased reference", make_path}, kMaxFrames, true, true},
          {{"photonmap", "two-pass photon mapping, photons shared between frames", make_photonmap}, kMaxFrames, true},
          {{"sppm", "stochastic progressive photon mapping, frame by frame", make_sppm}, 1, true, true, true},
          {{"vcm", "vertex connection and merging: bidirectional paths and photons, all frames together", make_vcm},
           kMaxFrames,
           true},
      },
      {"lightpath", "randomwalk", "bdpt", "mlt", "function"});
  return table;
}

}  // namespace dspm
