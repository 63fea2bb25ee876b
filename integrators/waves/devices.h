// The devices that trace waves.
#pragma once

#include <memory>
#include <string>

#include "dspm/integrators/integrator.h"
#include "dspm/integrators/waves/wave_tracer.h"

namespace dspm {

/// Returns whether the module for GPUs lies where it should.
bool has_gpu_module();
/// Returns why no GPU can be used, in words that follow "because"; empty: one can. What has an answer once keeps it.
std::string why_no_gpu();

/// Returns null for the CPU. Throws MachineFailure if there is no GPU for Device::gpu.
std::unique_ptr<WaveTracer> tracer_on(Device device);

}  // namespace dspm
