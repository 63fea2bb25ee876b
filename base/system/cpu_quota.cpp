#include "dspm/base/system/cpu_quota.h"

#include <algorithm>
#include <fstream>

#include "dspm/base/system/cgroups.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

/// Reads "150000 100000" or "max 100000"; in the first version two files, in which -1 means none.
std::optional<double> quota_of(const fs::path& group) {
  double quota = 0, period = 0;
  std::ifstream both(group / "cpu.max");
  if (!(both >> quota >> period)) {
    std::ifstream quota_file(group / "cpu.cfs_quota_us"), period_file(group / "cpu.cfs_period_us");
    if (!(quota_file >> quota) || !(period_file >> period)) return std::nullopt;
  }
  if (!(quota > 0) || !(period > 0)) return std::nullopt;
  return quota / period;
}

}  // namespace

std::optional<double> cpu_quota(const fs::path& root) {
  std::optional<double> least;
  for (const fs::path& group : cgroup_folders("cpu", root))
    if (const auto quota = quota_of(group)) least = std::min(*quota, least.value_or(*quota));
  return least;
}

}  // namespace dspm
