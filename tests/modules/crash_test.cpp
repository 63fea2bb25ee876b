// A module that ends the process is named, and the files that were written before are, too.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/modules/mischief.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace crash_test {

/// A run with an integrator that ends it in its second iteration.
Outcome run_in_mood(const TinyDirectory& directory, const std::string& mood,
                    const std::vector<std::string>& more_arguments) {
  put_file(directory / "tiny.dsc", tiny_scene("Integrator \"dsppm\" \"string indirect\" \"photons\" \"integer "
                                              "iterations\" 2 \"integer photons\" 200 \"integer seed\" 5",
                                              "Integrator \"mischief\" \"string mood\" \"" + mood + "\""));
  std::vector<std::string> arguments{"--plugin", DSPM_TEST_MODULES "/libmischief.so", "tiny.dsc"};
  arguments.insert(arguments.end(), more_arguments.begin(), more_arguments.end());
  const auto without_core = [] {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
  };
  return Process(directory, arguments, "out.txt", "err.txt", without_core).wait();
}

struct End {
  std::string mood;
  int code;
  std::string cause;
};

TEST(Crash, NamesTheModuleAndTheImagesBefore) {
  std::vector<End> ends = {
      {"abort", -SIGABRT, "Aborted"},
      {"exit", 1, "exit() was called"},
      {"_exit", 1, "_exit() was called"},
      {"_Exit", 1, "_Exit() was called"},
      {"quick_exit", 1, "quick_exit() was called"},
      {"exit in a thread", 1, "exit() was called"},
      {"throw in a thread", 1, "out of thread"},
  };
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they report it themselves
  ends.push_back({"segfault", -SIGSEGV, "Segmentation fault"});
#endif
  for (const End& end : ends) {
    const TinyDirectory directory;
    const Outcome outcome = run_in_mood(directory, end.mood, {"--write-every", "1"});
    EXPECT_EQ(outcome.code, end.code) << end.mood;
    expect_contains(outcome.err, "dspm: ended in iteration 2: " + end.cause +
                                     ", at work: integrator \"mischief\" of libmischief.so\n" +
                                     "dspm: the images so far: tiny.0001.exr to tiny.0003.exr\n");
    expect_paintings(directory);
  }
}

TEST(Crash, NamesTheCheckpoint) {
  const TinyDirectory directory;
  const Outcome outcome =
      run_in_mood(directory, "abort", {"--checkpoint", "tiny.checkpoint", "--checkpoint-every", "1"});
  EXPECT_EQ(outcome.code, -SIGABRT);
  expect_contains(outcome.err,
                  "dspm: no images have been written (--write-every writes some); --resume tiny.checkpoint continues "
                  "from the last checkpoint\n");
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
  EXPECT_TRUE(directory.has("tiny.checkpoint"));
}

TEST(Crash, SaysIfNothingIsLeft) {
  const TinyDirectory directory;
  const Outcome outcome = run_in_mood(directory, "exit", {});
  EXPECT_EQ(outcome.code, 1);
  expect_contains(outcome.err, "dspm: no images have been written (--write-every writes some)\n");
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
}

}  // namespace crash_test
}  // namespace dspm::test
