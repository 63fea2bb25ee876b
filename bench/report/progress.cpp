#include "bench/report/progress.h"

#include <chrono>
#include <cstdio>

namespace dspm {
namespace {

const auto g_begin = std::chrono::steady_clock::now();

}  // namespace

void say_line(const std::string& line) {
  const auto seconds =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - g_begin).count();
  fmt::print(stderr, "{:3}:{:02} {}\n", seconds / 60, seconds % 60, line);
}

}  // namespace dspm
