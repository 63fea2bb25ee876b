#include "dspm/testing/checks.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <string_view>

#include "dspm/session/modules/load.h"

namespace dspm::test {

void Checks::add(const std::string& what, const std::function<Verdict()>& check) {
  if (what.find(only_) == what.npos) return;
  const auto begin = std::chrono::steady_clock::now();
  Verdict verdict;
  try {
    verdict = check();
  } catch (const std::exception& error) {
    verdict.fail(error.what());
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  ++count_;
  if (!verdict.passed) ++failures_;
  std::printf("%s %s (%.1f s)%s%s\n", verdict.passed ? "passed" : "FAILED", what.c_str(), seconds.count(),
              verdict.message.empty() ? "" : ": ", verdict.message.c_str());
  std::fflush(stdout);  // so that it is not lost if a later check ends the program
}

int run_checks(int count, char** arguments, const std::function<void(Checks&)>& checks) {
  try {
    std::string only;
    for (int i = 1; i < count; ++i) {
      if (std::string_view(arguments[i]) == "--only" && i + 1 < count)
        only = arguments[++i];
      else
        load_module(arguments[i]);
    }
    Checks made(only);
    checks(made);
    if (made.passed()) return 0;
    if (made.count() == 0) std::fprintf(stderr, "no check has \"%s\" in its name\n", only.c_str());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace dspm::test
