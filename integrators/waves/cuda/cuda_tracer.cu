// The module that traces waves on an NVIDIA card; devices.cpp loads it.
#include <cuda_runtime.h>

#include <string>

#include "dspm/integrators/waves/cuda/cuda_machine.h"
#include "dspm/integrators/waves/wave_tracer_on.h"

namespace {

std::string why_no_card() {
  int driver = 0, runtime = 0, cards = 0;
  if (cudaDriverGetVersion(&driver) != cudaSuccess || driver == 0) return "there is no NVIDIA driver";
  const cudaError_t result = cudaGetDeviceCount(&cards);
  if (result == cudaErrorInsufficientDriver) {
    const auto in_words = [](int version) {
      return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
    };
    cudaRuntimeGetVersion(&runtime);
    return "the NVIDIA driver is too old: it is for CUDA " + in_words(driver) + ", and dspm was built by CUDA " +
           in_words(runtime);
  }
  if (result == cudaErrorNoDevice || (result == cudaSuccess && cards == 0)) return "there is no NVIDIA card";
  return result == cudaSuccess ? "" : cudaGetErrorString(result);
}

}  // namespace

/// Returns null if there is no card that can be used, and sets the reason.
extern "C" dspm::WaveTracer* dspm_cuda_tracer(std::string* why) {
  *why = why_no_card();
  if (!why->empty()) return nullptr;
  try {
    return new dspm::WaveTracerOn<dspm::CudaMachine>();
  } catch (const std::exception& error) {
    *why = error.what();
    return nullptr;
  }
}
