#include "dspm/base/system/readable.h"

#include <fmt/format.h>

#include <cmath>

namespace dspm {

std::string readable_bytes(std::size_t bytes) {
  const auto count = static_cast<double>(bytes);
  return bytes < 1000        ? fmt::format("{} B", bytes)
         : bytes < 1'000'000 ? fmt::format("{:.1f} KB", count / 1e3)
                             : fmt::format("{:.1f} MB", count / 1e6);
}

std::string readable_time(double seconds) {
  const auto whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{:.1f}s", seconds);
  if (whole < 3600) return fmt::format("{}m{:02}s", whole / 60, whole % 60);
  return fmt::format("{}h{:02}m", whole / 3600, whole / 60 % 60);
}

std::string counted(std::size_t count, const char* word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string readable_share(double share) { return fmt::format("{:.3g}%", 100 * share); }

std::string grouped(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

}  // namespace dspm
