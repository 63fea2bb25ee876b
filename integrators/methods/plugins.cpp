// The table of integrators.
#include "dspm/integrators/methods/ambient_occlusion.h"
#include "dspm/integrators/methods/dsppm/dsppm.h"
#include "dspm/integrators/methods/path.h"
#include "dspm/integrators/methods/photonmap.h"
#include "dspm/integrators/methods/sppm.h"
#include "dspm/integrators/methods/vcm/vcm.h"

namespace dspm {

PluginTable<IntegratorPlugin>& integrator_plugins() {
  static PluginTable<IntegratorPlugin> table(
      "integrator",
      {
          {{"ambientocclusion", "how much of the sky the first surface sees", make_ambient_occlusion}},
          {{"dsppm", "dynamic stochastic progressive photon mapping: all frames together", make_dsppm}},
          {{"path", "path tracing, the unbiased reference", make_path}},
          {{"photonmap", "two-pass photon mapping, photons shared between frames", make_photonmap}},
          {{"sppm", "stochastic progressive photon mapping, frame by frame", make_sppm}, 1},
          {{"vcm", "vertex connection and merging: bidirectional paths and photons, all frames together", make_vcm}},
      },
      {"lightpath", "randomwalk", "bdpt", "mlt", "function"});
  return table;
}

}  // namespace dspm
