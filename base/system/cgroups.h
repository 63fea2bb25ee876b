// The control groups that bound what the program may use, as a container or a scheduler has set them up.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace dspm {

/// Returns the folders of the group that the program is in for this controller ("cpu", "memory") and of all around it;
/// some may not exist. `root` is that of the file system. [Linux, Documentation/admin-guide/cgroup-v2.rst and
/// cgroup-v1/cgroups.rst]
std::vector<std::filesystem::path> cgroup_folders(std::string_view controller, const std::filesystem::path& root = "/");

}  // namespace dspm
