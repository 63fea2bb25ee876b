#include "dspm/base/system/machine.h"

#include <fmt/format.h>
#include <gnu/libc-version.h>

#include <vector>

namespace dspm {

std::string machine_in_words() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  std::vector<const char*> has;
  if (__builtin_cpu_supports("avx2")) has.push_back("AVX2");
  if (__builtin_cpu_supports("fma")) has.push_back("FMA");
  if (__builtin_cpu_supports("avx512f")) has.push_back("AVX-512");
  return fmt::format("x86-64 with {}; glibc {}", has.empty() ? "SSE4.2" : fmt::format("{}", fmt::join(has, ", ")),
                     gnu_get_libc_version());
#else
  return fmt::format("arm64; glibc {}", gnu_get_libc_version());
#endif
}

}  // namespace dspm
