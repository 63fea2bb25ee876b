// What a container or a scheduler leaves of the processors.
#include "dspm/base/system/cpu_quota.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

class CpuQuota : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((root / name).parent_path());
    put_file(root / name, text);
  }
  std::optional<double> quota() const { return cpu_quota(root / ""); }

  TemporaryDirectory root;
};

TEST_F(CpuQuota, IsNoneWithoutGroups) { EXPECT_EQ(quota(), std::nullopt); }

TEST_F(CpuQuota, OfTheSecondVersionIsTheLeastOfAllGroupsAround) {
  put("proc/self/cgroup", "0::/jobs/mine\n");
  put("sys/fs/cgroup/jobs/mine/cpu.max", "max 100000\n");
  EXPECT_EQ(quota(), std::nullopt);
  put("sys/fs/cgroup/jobs/cpu.max", "150000 100000\n");
  EXPECT_EQ(quota(), 1.5);
  put("sys/fs/cgroup/jobs/mine/cpu.max", "400000 100000\n");
  EXPECT_EQ(quota(), 1.5);
}

TEST_F(CpuQuota, OfAContainerIsThatOfItsMount) {
  put("proc/self/cgroup", "0::/\n");
  put("sys/fs/cgroup/cpu.max", "50000 100000\n");
  EXPECT_EQ(quota(), 0.5);
}

TEST_F(CpuQuota, OfTheFirstVersionHasTwoFiles) {
  put("proc/self/cgroup", "9:memory:/a\n4:cpu,cpuacct:/docker/17\n");
  put("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  put("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(quota(), std::nullopt);
  put("sys/fs/cgroup/cpu,cpuacct/docker/17/cpu.cfs_quota_us", "300000\n");
  put("sys/fs/cgroup/cpu,cpuacct/docker/17/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(quota(), 3);
}

}  // namespace
}  // namespace dspm::test
