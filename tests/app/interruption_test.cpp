// Signals and limits: a run that is stopped early leaves images.
#include <gtest/gtest.h>

#include "dspm/image/exr.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

TEST(Interruption, CtrlCFinishesTheIterationAndWrites) {
  const TinyDirectory directory;
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--write-every", "1", "--stats=stats.json"});
  ASSERT_TRUE(appears(directory / "tiny.0003.exr"));
  std::filesystem::remove(directory / "tiny.0003.exr");
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
  EXPECT_GE(read_exr_header(directory / "tiny.0003.exr").integers.at("iterations"), 1);
  EXPECT_NE(contents(directory / "stats.json").find("\"exit_code\": 130"), std::string::npos);
}

TEST(Interruption, TerminationDoesLikewise) {
  const TinyDirectory directory;
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--write-every", "1"});
  ASSERT_TRUE(appears(directory / "tiny.0003.exr"));
  process.send(SIGTERM);
  EXPECT_EQ(process.wait().code, 143);
}

// By which schedulers warn before they kill; the system repeats SIGXCPU every second.
TEST(Interruption, SchedulersWarningsDoLikewise) {
  for (const int signal : {SIGXCPU, SIGUSR2}) {
    const TinyDirectory directory;
    const Process process(directory,
                          {"tiny.dsc", "--iterations", "0", "--write-every", "1", "--checkpoint", "tiny.ck"});
    ASSERT_TRUE(appears(directory / "tiny.0003.exr"));
    std::filesystem::remove(directory / "tiny.0003.exr");
    process.send(signal), process.send(signal);
    EXPECT_EQ(process.wait().code, 128 + signal);
    EXPECT_TRUE(directory.has("tiny.0003.exr"));
    EXPECT_TRUE(directory.has("tiny.ck"));
  }
}

// As `perl -e 'alarm 1; exec "dspm", ...'` sets one, which lives through exec.
TEST(Interruption, AnInheritedAlarmDoesLikewise) {
  const TinyDirectory directory;
  const Process process(directory, {"tiny.dsc", "--iterations", "0"}, "out.txt", "err.txt", [] { alarm(2); });
  const Outcome outcome = process.wait();
  if (outcome.code == -SIGALRM) GTEST_SKIP() << "the machine is too busy: the alarm came before the run began";
  EXPECT_EQ(outcome.code, 142) << outcome.err;
  EXPECT_GE(read_exr_header(directory / "tiny.0003.exr").integers.at("iterations"), 1);
}

TEST(Interruption, TheSecondCtrlCEndsAtOnce) {
  const TinyDirectory directory;
  // One iteration takes long: many photons.
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--photons", "500000000", "-t", "1"});
  ASSERT_TRUE(says(directory, "memory"));
  process.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  process.send(SIGINT);
  EXPECT_EQ(process.wait().code, 130);
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
}

TEST(Interruption, ATimeLimitEndsTheRun) {
  const TinyDirectory directory;
  const auto begin = std::chrono::steady_clock::now();
  const Outcome outcome = run(directory, {"tiny.dsc", "--iterations", "0", "--time-limit", "0.5s"});
  EXPECT_EQ(outcome.err.find("none is left"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_GT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(500));
  EXPECT_TRUE(directory.has("tiny.0003.exr"));
}

TEST(Interruption, ATimeLimitIsSharedByTheFrameIntervalsAndUsedUp) {
  const TinyDirectory directory;
  const auto begin = std::chrono::steady_clock::now();
  // sppm renders one frame after the other.
  const Outcome outcome =
      run(directory, {"tiny.dsc", "--integrator", "sppm", "--iterations", "0", "--time-limit", "1.8s"});
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1800));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : kTinyImages) {
    const double seconds = read_exr_header(directory / name).numbers.at("seconds");
    EXPECT_GT(seconds, 0.2) << name;
    EXPECT_LT(seconds, 1.8) << name;
  }
}

}  // namespace
}  // namespace dspm::test
