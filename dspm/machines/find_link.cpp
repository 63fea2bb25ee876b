#include "dspm/machines/find_link.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "dspm/params/errors.h"

namespace dspm {
namespace {

/// By what Open MPI, and schedulers that start its programs themselves, leave in the environment.
bool was_started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

/// Next to the library that this code is in.
std::filesystem::path module_file() {
  Dl_info info{};
  dladdr(reinterpret_cast<const void*>(&find_link), &info);
  std::error_code error;
  const std::filesystem::path library = std::filesystem::canonical(info.dli_fname, error);
  return library.parent_path() / DSPM_MPI_MODULE;
}

}  // namespace

std::unique_ptr<Link> find_link() {
  if (!was_started_by_mpi()) return nullptr;
  const std::filesystem::path file = module_file();
  // Open MPI loads modules of its own, which look for its library among those that everybody sees.
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (module == nullptr)
    throw UsageError(
        fmt::format("MPI has started this program, and its module for MPI cannot be loaded ({}); build dspm where "
                    "libopenmpi-dev is installed, or start it without mpirun",
                    dlerror()));
  using MakeLink = Link*();
  return std::unique_ptr<Link>(reinterpret_cast<MakeLink*>(dlsym(module, "dspm_link"))());
}

}  // namespace dspm
