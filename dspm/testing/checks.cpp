#include "dspm/testing/checks.h"

#include <cstdio>
#include <exception>

#include "dspm/modules/load.h"

namespace dspm::test {

void Checks::add(const std::string& what, const Verdict& verdict) {
  ++count_;
  if (!verdict.passed) ++failures_;
  std::printf("%s %s: %s\n", verdict.passed ? "passed" : "FAILED", what.c_str(), verdict.message.c_str());
  std::fflush(stdout);  // kept where a later check ends the program
}

int run_checks(int count, char** arguments, const std::function<void(Checks&)>& checks) {
  try {
    for (int i = 1; i < count; ++i) load_module(arguments[i]);
    Checks made;
    checks(made);
    return made.passed() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace dspm::test
