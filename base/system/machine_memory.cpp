#include "dspm/base/system/machine_memory.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "dspm/base/system/cgroups.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

std::optional<std::size_t> limit_of(const fs::path& group) {
  for (const char* name : {"memory.max", "memory.limit_in_bytes"}) {
    std::ifstream file(group / name);
    if (std::size_t limit = 0; file >> limit) return limit;  // else "max"
  }
  return std::nullopt;
}

}  // namespace

MachineMemory machine_memory(const fs::path& root) {
  MachineMemory memory;
  std::ifstream lines(root / "proc/meminfo");
  std::string name, unit;
  for (std::size_t kilobytes = 0; lines >> name >> kilobytes; std::getline(lines, unit)) {
    if (name == "MemTotal:") memory.total = 1024 * kilobytes;
    if (name == "MemAvailable:") memory.available = 1024 * kilobytes;
  }
  for (const fs::path& group : cgroup_folders("memory", root))
    if (const auto limit = limit_of(group)) memory.limit = std::min(*limit, memory.limit.value_or(*limit));
  // The first version writes "none" as a number beyond all memory.
  if (memory.limit && memory.total > 0 && *memory.limit >= memory.total) memory.limit.reset();
  return memory;
}

}  // namespace dspm
