// A shell script in place of ffmpeg, first in PATH as long as it lives.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "tests/support/temporary_directory.h"

namespace dspm::test {

class FakeFfmpeg {
 public:
  /// Without a script, PATH holds no ffmpeg.
  explicit FakeFfmpeg(const std::string& script) : path_(getenv("PATH")) {
    if (!script.empty()) put_file(directory_ / "ffmpeg", "#!/bin/sh\nhere=$(dirname \"$0\")\n" + script);
    if (!script.empty()) std::filesystem::permissions(directory_ / "ffmpeg", std::filesystem::perms::owner_all);
    const std::string own = (directory_ / "").string();
    setenv("PATH", (script.empty() ? own : own + ":" + path_).c_str(), 1);
  }
  ~FakeFfmpeg() { setenv("PATH", path_.c_str(), 1); }
  FakeFfmpeg(const FakeFfmpeg&) = delete;
  FakeFfmpeg& operator=(const FakeFfmpeg&) = delete;

  /// What its last run got.
  std::string arguments() const { return contents(directory_ / "arguments"); }
  std::string input() const { return contents(directory_ / "input"); }

 private:
  TemporaryDirectory directory_;
  std::string path_;
};

/// Keeps what it got, and writes "film" into the file that it is given last.
inline const std::string kKeepAll = R"(
printf '%s\n' "$@" >"$here/arguments"
cat >"$here/input"
for last; do :; done
printf film >"${last#file:}"
)";
/// The second run, the one behind the trial, fails.
inline const std::string kFailLate = R"(
if [ -e "$here/input" ]; then echo 'the disk is full' >&2; exit 3; fi
cat >"$here/input"
)";

}  // namespace dspm::test
