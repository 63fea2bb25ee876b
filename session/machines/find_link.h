// The link to other machines, if a tool that knows them has started this program.
#pragma once

#include <memory>
#include <string>

#include "dspm/session/machines/link.h"

namespace dspm {

/// Returns null if the program was started by itself. Throws UsageError if it was started by mpirun, and the module for
/// MPI is missing.
std::unique_ptr<Link> find_link();

/// Returns whether the module for MPI is beside the library.
bool has_mpi_module();
/// Loads the module for MPI. Returns why that failed, or an empty string.
std::string fault_of_mpi_module();

}  // namespace dspm
