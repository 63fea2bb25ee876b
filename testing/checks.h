// A program that tests modules, without a test library:
//
//   int main(int count, char** arguments) {
//     return dspm::test::run_checks(count, arguments, [](dspm::test::Checks& checks) {
//       checks.add("scattering", [] { return dspm::test::check_scattering("\"velvet\""); });
//     });
//   }
//
// velvet_test libvelvet.so --only scatter  makes the checks whose names hold that word.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "dspm/testing/verdict.h"

namespace dspm::test {

class Checks {
 public:
  /// Runs only the checks whose names contain `only`, or all if it is empty.
  explicit Checks(std::string only) : only_(std::move(only)) {}

  /// Runs the check, and prints its verdict and time. An exception is a failure of this check alone.
  void add(const std::string& what, const std::function<Verdict()>& check);
  int count() const { return count_; }
  bool passed() const { return failures_ == 0 && count_ > 0; }

 private:
  std::string only_;
  int count_ = 0, failures_ = 0;
};

/// Loads the modules that the command line names, then runs the checks. Returns the exit code: 0 if there were checks
/// and all passed.
int run_checks(int count, char** arguments, const std::function<void(Checks&)>& checks);

}  // namespace dspm::test
