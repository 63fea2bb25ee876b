#include "dspm/session/machines/find_link.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "dspm/base/params/errors.h"
#include "dspm/base/system/beside_library.h"

namespace dspm {
namespace {

bool is_above_one(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr && std::atoi(value) > 1;
}

/// Returns whether Open MPI, or a scheduler that starts its programs itself, has left its variables in the environment.
/// Schedulers do so for single processes, too, which need no MPI.
bool was_started_by_mpi() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr ||
         (std::getenv("PMI_RANK") != nullptr && is_above_one("PMI_SIZE")) ||
         (std::getenv("PMIX_RANK") != nullptr && is_above_one("SLURM_STEP_NUM_TASKS"));
}

std::filesystem::path module_file() { return beside_library(DSPM_MPI_MODULE); }

using MakeLink = Link*();

/// Returns null if the module cannot be loaded, for the reason that dlerror() gives.
MakeLink* load_module() {
  // Open MPI loads modules of its own, which look for its library among those that everybody sees.
  void* const module = dlopen(module_file().c_str(), RTLD_NOW | RTLD_GLOBAL);
  return module != nullptr ? reinterpret_cast<MakeLink*>(dlsym(module, "dspm_link")) : nullptr;
}

}  // namespace

std::unique_ptr<Link> find_link() {
  if (!was_started_by_mpi()) return nullptr;
  MakeLink* const make = load_module();
  if (make == nullptr)
    throw UsageError(
        fmt::format("MPI has started this program, and its module for MPI cannot be loaded ({}); build dspm where "
                    "libopenmpi-dev is installed, or start it without mpirun",
                    dlerror()));
  return std::unique_ptr<Link>(make());
}

bool has_mpi_module() {
  std::error_code none;
  return std::filesystem::exists(module_file(), none);
}

std::string fault_of_mpi_module() { return load_module() != nullptr ? "" : dlerror(); }

}  // namespace dspm
