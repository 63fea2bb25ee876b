// The share of the machine's time that a container or a scheduler leaves to the program.
#pragma once

#include <filesystem>
#include <optional>

namespace dspm {

/// Returns the quota, in processors, of the cgroup that the program is in and of all around it; nullopt if there is no
/// bound. `root` is that of the file system. [Linux, Documentation/admin-guide/cgroup-v2.rst, cpu.max; cgroup-v1,
/// cpu.cfs_quota_us]
std::optional<double> cpu_quota(const std::filesystem::path& root = "/");

}  // namespace dspm
