#include "bench/report/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <thread>

namespace dspm {
namespace {

/// The text after `key` and a separator in the first line of the file that begins with it.
std::string value_in(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const std::size_t begin = line.find_first_not_of(":=\t \"", key.size());
    const std::size_t end = line.find_last_not_of("\" ");
    return begin == line.npos ? "" : line.substr(begin, end - begin + 1);
  }
  return "unknown";
}

std::string output_of(const char* command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), pclose);
  std::string text;
  for (int c; pipe != nullptr && (c = std::fgetc(pipe.get())) != EOF;) text += static_cast<char>(c);
  return text.substr(0, text.find('\n'));
}

std::string compiler() {
#ifdef __clang__
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

std::string machine_and_build_in_words() {
  const double kilobytes = std::strtod(value_in("/proc/meminfo", "MemTotal").c_str(), nullptr);
#ifdef NDEBUG
  const char* build = "optimised build";
#else
  const char* build = "build with assertions";
#endif
  return fmt::format("{}, {} cores, {:.0f} GB of memory, {}, {}, {}", value_in("/proc/cpuinfo", "model name"),
                     std::thread::hardware_concurrency(), kilobytes * 1024e-9,
                     value_in("/etc/os-release", "PRETTY_NAME"), compiler(), build);
}

std::string date_and_commit() {
  const std::string commit = output_of("git -C '" DSPM_SOURCE_DIR "' describe --always --exclude='*' 2>/dev/null");
  // Without docs, which this program writes.
  const std::string changes = output_of("git -C '" DSPM_SOURCE_DIR "' status --porcelain -- . ':!docs' 2>/dev/null");
  const std::time_t now = std::time(nullptr);
  return fmt::format("{:%Y-%m-%d}, commit {}{}", *std::gmtime(&now), commit.empty() ? "unknown" : commit,
                     changes.empty() ? "" : " with changes");
}

}  // namespace dspm
