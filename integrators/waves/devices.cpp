#include "dspm/integrators/waves/devices.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "dspm/base/system/beside_library.h"
#include "dspm/integrators/waves/threads_machine.h"
#include "dspm/integrators/waves/wave_tracer_on.h"

namespace dspm {
namespace {

using MakeTracer = WaveTracer*(std::string* why_not);

std::filesystem::path module_file() { return beside_library(DSPM_CUDA_MODULE); }

/// Returns null, and the reason, if the module cannot be loaded.
MakeTracer* load_module(std::string& why_not) {
  if (!has_gpu_module()) {
    why_not = "this dspm was built without nvcc, the compiler for NVIDIA's GPUs";
    return nullptr;
  }
  void* const module = dlopen(module_file().c_str(), RTLD_NOW);
  void* const make = module != nullptr ? dlsym(module, "dspm_cuda_tracer") : nullptr;
  if (make == nullptr) why_not = fmt::format("its module for GPUs cannot be loaded ({})", dlerror());
  return reinterpret_cast<MakeTracer*>(make);
}

std::unique_ptr<WaveTracer> tracer_on_gpu(std::string& why_not) {
  static std::string why_no_module;
  static MakeTracer* const make = load_module(why_no_module);
  why_not = why_no_module;
  return std::unique_ptr<WaveTracer>(make != nullptr ? make(&why_not) : nullptr);
}

}  // namespace

bool has_gpu_module() {
  std::error_code none;
  return std::filesystem::exists(module_file(), none);
}

std::string why_no_gpu() {
  static const std::string why = [] {
    std::string why_not;
    tracer_on_gpu(why_not);
    return why_not;
  }();
  return why;
}

std::unique_ptr<WaveTracer> tracer_on(Device device) {
  if (device == Device::cpu) return nullptr;
  if (device == Device::waves) return std::make_unique<WaveTracerOn<ThreadsMachine>>();
  std::string why_not;
  std::unique_ptr<WaveTracer> tracer = tracer_on_gpu(why_not);
  if (tracer == nullptr) throw MachineFailure(why_not);
  return tracer;
}

}  // namespace dspm
