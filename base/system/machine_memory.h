// The memory of the machine, and what a container or a scheduler leaves of it to the program.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace dspm {

/// In bytes.
struct MachineMemory {
  std::size_t total = 0, available = 0;  // of the whole machine; 0: the system does not say
  std::optional<std::size_t> limit;      // of the cgroup that the program is in and of all around it
};

/// `root` is that of the file system. [Linux, proc(5), meminfo; cgroup-v2.rst, memory.max; cgroup-v1/memory.rst,
/// memory.limit_in_bytes]
MachineMemory machine_memory(const std::filesystem::path& root = "/");

}  // namespace dspm
