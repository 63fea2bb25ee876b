// A shell script in place of ffmpeg.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/fake_program.h"

namespace dspm::test {

class FakeFfmpeg : public FakeProgram {
 public:
  explicit FakeFfmpeg(const std::string& script) : FakeProgram("ffmpeg", script) {}

  /// Where kSayProcess writes the process's number, and that number.
  std::filesystem::path process_file() const { return directory_ / "process"; }
  std::string process() const { return contents(process_file()); }
};

/// A line of a script, which tells who runs it.
inline const std::string kSayProcess = "echo $$ >\"$here/p\" && mv \"$here/p\" \"$here/process\"\n";
/// The shortest film that is whole.
inline const std::string kFilm("\0\0\0\10ftyp\0\0\0\10moov\0\0\0\10mdat", 24);
/// For a script's begin: `film` writes the shortest film into the file that it is given last.
inline const std::string kWriteFilm = R"(
for last; do :; done
film() { printf '\0\0\0\10ftyp\0\0\0\10moov\0\0\0\10mdat' >"${last#file:}"; }
)";
/// Keeps what it got, and writes kFilm.
inline const std::string kKeepAll = kWriteFilm + R"(
printf '%s\n' "$@" >"$here/arguments"
cat >"$here/input"
film
)";
/// What behind the trial runs in place of the second ffmpeg.
inline std::string only_once(const std::string& then) {
  return kWriteFilm + "if [ -e \"$here/input\" ]; then\n" + then + "\nfi\ncat >\"$here/input\"; film\n";
}
/// The second run, the one behind the trial, fails.
inline const std::string kFailLate = only_once("echo 'the disk is full' >&2; exit 3");

}  // namespace dspm::test
