// The result of a check: a plain value, for any test library or none.
#pragma once

#include <string>

namespace dspm::test {

struct Verdict {
  bool passed = true;
  std::string message;  // figures; of several failures, the first

  void fail(const std::string& why) {
    if (passed) message = why;
    passed = false;
  }
};

}  // namespace dspm::test
