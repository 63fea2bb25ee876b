// The integrators.
#include "integrators/dsppm/dsppm.h"
#include "integrators/path.h"
#include "integrators/photonmap.h"
#include "integrators/sppm.h"

namespace dspm {
namespace {

constexpr Plugin<MakeIntegrator> kIntegrators[] = {
    {"dsppm", "dynamic stochastic progressive photon mapping: all frames together", make_dsppm},
    {"path", "path tracing, the unbiased reference", make_path},
    {"photonmap", "two-pass photon mapping, photons shared between frames", make_photonmap},
    {"sppm", "stochastic progressive photon mapping, frame by frame", make_sppm},
};

}  // namespace

std::span<const Plugin<MakeIntegrator>> integrator_plugins() { return kIntegrators; }

int frames_together(std::string_view integrator) { return integrator == "sppm" ? 1 : kMaxFrames; }

}  // namespace dspm
