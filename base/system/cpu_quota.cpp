#include "dspm/base/system/cpu_quota.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace dspm {
namespace {

namespace fs = std::filesystem;

/// Reads "max 100000" or "150000 100000".
std::optional<double> quota_of_v2(const fs::path& group) {
  std::ifstream file(group / "cpu.max");
  double quota = 0, period = 0;
  if (!(file >> quota >> period) || !(quota > 0) || !(period > 0)) return std::nullopt;
  return quota / period;
}

/// Reads a quota, of which -1 means none.
std::optional<double> quota_of_v1(const fs::path& group) {
  std::ifstream quota_file(group / "cpu.cfs_quota_us"), period_file(group / "cpu.cfs_period_us");
  double quota = 0, period = 0;
  if (!(quota_file >> quota) || !(period_file >> period) || !(quota > 0) || !(period > 0)) return std::nullopt;
  return quota / period;
}

/// Returns the least quota of a group and those around it. In a container, the group's path may be the host's, and its
/// own group is the mount itself.
template <class QuotaOf>
std::optional<double> least_quota(const fs::path& mount, fs::path group, QuotaOf quota_of) {
  std::optional<double> least = quota_of(mount);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path())
    if (const auto quota = quota_of(mount / group)) least = std::min(*quota, least.value_or(*quota));
  return least;
}

bool names(const std::string& controllers, const std::string& one) {
  return ("," + controllers + ",").find("," + one + ",") != std::string::npos;
}

}  // namespace

std::optional<double> cpu_quota(const fs::path& root) {
  std::optional<double> least;
  const auto add = [&](std::optional<double> quota) {
    if (quota) least = std::min(*quota, least.value_or(*quota));
  };
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "0::/path", or in the first version "4:cpu,cpuacct:/path"
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == line.npos || second == line.npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
    const fs::path mounts = root / "sys/fs/cgroup";
    if (controllers.empty()) {
      add(least_quota(mounts, path, quota_of_v2));
      add(least_quota(mounts / "unified", path, quota_of_v2));
    } else if (names(controllers, "cpu")) {
      for (const std::string& mount : {controllers, std::string("cpu")})
        add(least_quota(mounts / mount, path, quota_of_v1));
    }
  }
  return least;
}

}  // namespace dspm
