// What --doctor says of an installation, whole or not.
#include <gtest/gtest.h>

#include "tests/support/fake_ffmpeg.h"
#include "tests/support/process.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DSPM_ADDRESS_SPACE_OF_ITS_OWN 1  // a sanitizer takes more than any limit of these
#endif

namespace dspm::test {
namespace {

/// Returns the lines between a title and the next empty line.
std::string list_under(const std::string& title, const std::string& text) {
  const std::size_t at = text.find("\n" + title);
  return at == text.npos ? "" : text.substr(at, text.find("\n\n", at + 1) - at);
}

class Doctor : public ::testing::Test {
 protected:
  /// Runs --doctor, and returns what it says of a part: "found", "missing", or "" if it says nothing or both.
  std::string state_of(const std::string& part) {
    outcome = run(directory, {"--doctor", "--nthreads", "1"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto has = [&](const char* list) {
      return list_under(list, outcome.out).find("\n  " + part + "  ") != std::string::npos;
    };
    const bool found = has("optional parts found"), missing = has("optional parts missing");
    return found == missing ? "" : found ? "found" : "missing";
  }
  bool says(const std::string& words) const { return outcome.out.find(words) != std::string::npos; }

  TemporaryDirectory directory;
  Outcome outcome;
};

TEST_F(Doctor, FindsWhatWorks) {
  const FakeFfmpeg ffmpeg(kKeepAll);
  EXPECT_EQ(state_of("ffmpeg"), "found");
  EXPECT_TRUE(says("\n  rendering  works")) << outcome.out;
  EXPECT_TRUE(says("\n  threads    1 of ")) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(directory.file_count(), 2) << "out.txt and err.txt";
}

TEST_F(Doctor, NamesThePackageOfWhatIsMissing) {
  const FakeFfmpeg nothing("");
  EXPECT_EQ(state_of("mpirun"), "missing");
  EXPECT_TRUE(says("openmpi-bin")) << outcome.out;
  EXPECT_TRUE(says("(mpirun is not on the PATH)")) << outcome.out;
  EXPECT_TRUE(says("\n  rendering  works")) << outcome.out;
}

TEST_F(Doctor, TriesPrograms) {
  const FakeFfmpeg ffmpeg("echo 'Unknown encoder libx264' >&2; exit 3");
  EXPECT_EQ(state_of("ffmpeg"), "missing");
  EXPECT_TRUE(says("(ffmpeg failed with exit code 3, saying: Unknown encoder libx264)")) << outcome.out;
}

TEST_F(Doctor, ModulesOfAnotherVersionDoNotCount) {
  const FakeProgram python("python3", "printf 'Traceback\\nImportError: it is another\\n' >&2; exit 1");
  EXPECT_EQ(state_of("Python module"), "missing");
  EXPECT_TRUE(says("(ImportError: it is another)")) << outcome.out;
}

TEST_F(Doctor, ExitsWithOneIfItCannotRender) {
#ifdef DSPM_ADDRESS_SPACE_OF_ITS_OWN
  GTEST_SKIP();
#endif
  double bytes = 30e6;
  while (bytes < 1e9 && run_below(directory, bytes, {"--version"}).code != 0) bytes *= 1.15;
  outcome = run_below(directory, bytes, {"--doctor"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(says("\n  rendering  fails: ")) << outcome.out;
}

}  // namespace
}  // namespace dspm::test
