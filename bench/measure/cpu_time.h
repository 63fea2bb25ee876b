// To time the work of one thread on a machine that others use as well.
#pragma once

#include <ctime>

namespace dspm {

/// Seconds that this thread has computed so far.
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace dspm
