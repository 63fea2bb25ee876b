// What the system says of a machine's memory and graphics cards.
#include <gtest/gtest.h>

#include "dspm/base/system/graphics_cards.h"
#include "dspm/base/system/machine_memory.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

class Machine : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((root / name).parent_path());
    put_file(root / name, text);
  }
  MachineMemory memory() const { return machine_memory(root / ""); }
  std::vector<std::string> cards() const { return graphics_cards(root / ""); }

  TemporaryDirectory root;
};

TEST_F(Machine, WithoutFilesHasUnknownMemoryAndNoCards) {
  EXPECT_EQ(memory().total, 0u);
  EXPECT_EQ(memory().limit, std::nullopt);
  EXPECT_TRUE(cards().empty());
}

TEST_F(Machine, MemoryIsBoundedByTheLeastLimitAround) {
  put("proc/meminfo",
      "MemTotal:        8000000 kB\nMemFree:  100 kB\nMemAvailable:    5000000 kB\nHugePages_Total:    3\n");
  put("proc/self/cgroup", "0::/jobs/mine\n");
  put("sys/fs/cgroup/jobs/mine/memory.max", "max\n");
  EXPECT_EQ(memory().total, 8000000ull * 1024);
  EXPECT_EQ(memory().available, 5000000ull * 1024);
  EXPECT_EQ(memory().limit, std::nullopt);
  put("sys/fs/cgroup/jobs/memory.max", "2000000000\n");
  EXPECT_EQ(memory().limit, 2000000000u);
  put("sys/fs/cgroup/jobs/mine/memory.max", "3000000000\n");
  EXPECT_EQ(memory().limit, 2000000000u);
}

TEST_F(Machine, MemoryOfTheFirstVersionOfGroups) {
  put("proc/meminfo", "MemTotal: 8000000 kB\n");
  put("proc/self/cgroup", "9:memory:/docker/17\n4:cpu,cpuacct:/a\n");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(memory().limit, std::nullopt);
  put("sys/fs/cgroup/memory/docker/17/memory.limit_in_bytes", "1000000000\n");
  EXPECT_EQ(memory().limit, 1000000000u);
}

TEST_F(Machine, CardsAreDisplaysOfKnownMakers) {
  const auto device = [&](const std::string& address, const char* kind, const char* maker, const char* number) {
    const std::string folder = "sys/bus/pci/devices/" + address;
    put(folder + "/class", std::string(kind) + "\n");
    put(folder + "/vendor", std::string(maker) + "\n");
    put(folder + "/device", std::string(number) + "\n");
  };
  device("0000:00:02.0", "0x030000", "0x8086", "0x4680");
  device("0000:01:00.0", "0x030200", "0x10de", "0x2331");
  device("0000:02:00.0", "0x020000", "0x8086", "0x1533");  // a network card
  device("0000:03:00.0", "0x030000", "0x1b36", "0x0100");  // a virtual machine's display
  EXPECT_EQ(cards(), (std::vector<std::string>{"Intel 0x4680", "NVIDIA 0x2331"}));
  put("proc/driver/nvidia/gpus/0000:01:00.0/information", "Model: \t\t NVIDIA H100 PCIe\nIRQ:   	 16\n");
  EXPECT_EQ(cards(), (std::vector<std::string>{"NVIDIA H100 PCIe", "Intel 0x4680"}));
}

}  // namespace
}  // namespace dspm::test
