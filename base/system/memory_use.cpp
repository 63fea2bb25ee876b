#include "dspm/base/system/memory_use.h"

#include <fstream>
#include <string>

namespace dspm {
namespace {

/// Reads the kernel's account. getrusage also counts the process before it became dspm: the copy of a large parent.
std::size_t kernels_account(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::size_t kilobytes = 0; word == name && status >> kilobytes) return 1024 * kilobytes;
  return 0;
}

}  // namespace

std::size_t peak_memory() { return kernels_account("VmHWM:"); }
std::size_t peak_address_space() { return kernels_account("VmPeak:"); }

}  // namespace dspm
