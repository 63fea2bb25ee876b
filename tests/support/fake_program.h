// A shell script in place of a program, first in PATH as long as it lives.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "tests/support/temporary_directory.h"

namespace dspm::test {

class FakeProgram {
 public:
  /// Without a script, PATH holds no program. A script finds its own directory in $here.
  FakeProgram(const std::string& name, const std::string& script) : path_(getenv("PATH")) {
    if (!script.empty()) put_file(directory_ / name, "#!/bin/sh\nhere=$(dirname \"$0\")\n" + script);
    if (!script.empty()) std::filesystem::permissions(directory_ / name, std::filesystem::perms::owner_all);
    const std::string own = (directory_ / "").string();
    setenv("PATH", (script.empty() ? own : own + ":" + path_).c_str(), 1);
  }
  ~FakeProgram() { setenv("PATH", path_.c_str(), 1); }
  FakeProgram(const FakeProgram&) = delete;
  FakeProgram& operator=(const FakeProgram&) = delete;

  /// What its last run got, if the script keeps it there.
  std::string arguments() const { return contents(directory_ / "arguments"); }
  std::string input() const { return contents(directory_ / "input"); }

 protected:
  TemporaryDirectory directory_;

 private:
  std::string path_;
};

}  // namespace dspm::test
