#include "dspm/base/system/cgroups.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

namespace dspm {
namespace {

namespace fs = std::filesystem;

/// In a container, the group's path may be the host's, and its own group is the mount itself.
void add_group_and_around(const fs::path& mount, fs::path group, std::vector<fs::path>& folders) {
  folders.push_back(mount);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path()) folders.push_back(mount / group);
}

bool names(const std::string& controllers, std::string_view one) {
  return fmt::format(",{},", controllers).find(fmt::format(",{},", one)) != std::string::npos;
}

}  // namespace

std::vector<fs::path> cgroup_folders(std::string_view controller, const fs::path& root) {
  std::vector<fs::path> folders;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "0::/path", or in the first version "4:cpu,cpuacct:/path"
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == line.npos || second == line.npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
    const fs::path mounts = root / "sys/fs/cgroup";
    if (controllers.empty()) {
      add_group_and_around(mounts, path, folders);
      add_group_and_around(mounts / "unified", path, folders);
    } else if (names(controllers, controller)) {
      add_group_and_around(mounts / controllers, path, folders);
      if (controllers != controller) add_group_and_around(mounts / controller, path, folders);
    }
  }
  return folders;
}

}  // namespace dspm
