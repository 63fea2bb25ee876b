// A program that tests modules, for those who use no library of tests:
//
//   int main(int count, char** arguments) {
//     return dspm::test::run_checks(count, arguments, [](dspm::test::Checks& checks) {
//       checks.add("scattering", dspm::test::check_scattering("\"velvet\""));
//     });
//   }
#pragma once

#include <functional>
#include <string>

#include "dspm/testing/verdict.h"

namespace dspm::test {

class Checks {
 public:
  /// Prints what was found.
  void add(const std::string& what, const Verdict& verdict);
  bool passed() const { return failures_ == 0 && count_ > 0; }

 private:
  int count_ = 0, failures_ = 0;
};

/// Loads the modules that the command line names, then runs the checks; the exit code: 0 where all passed, and there
/// were some.
int run_checks(int count, char** arguments, const std::function<void(Checks&)>& checks);

}  // namespace dspm::test
