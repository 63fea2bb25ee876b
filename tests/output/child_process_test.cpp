#include "dspm/base/system/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <system_error>

#include "tests/support/temporary_directory.h"

namespace dspm {
namespace child_process_test {

ChildProcess shell(const std::string& script, const std::string& argument = "") {
  return ChildProcess({"sh", "-c", script, argument});
}

TEST(ChildProcess, ReadsWhatIsWritten) {
  const test::TemporaryDirectory directory;
  ChildProcess child = shell("cat >\"$0\"", directory / "a b");
  const std::string much(1 << 20, 'x');
  child.write("one ");
  child.write(much);
  EXPECT_EQ(child.wait(), 0);
  EXPECT_EQ(test::contents(directory / "a b"), "one " + much);
}

TEST(ChildProcess, NoShellReadsTheWords) {
  const test::TemporaryDirectory directory;
  ChildProcess child({"touch", (directory / "a;b $HOME").string()});
  EXPECT_EQ(child.wait(), 0);
  EXPECT_TRUE(std::filesystem::exists(directory / "a;b $HOME"));
}

TEST(ChildProcess, TellsHowItEnded) {
  EXPECT_EQ(shell("exit 7").wait(), 7);
  EXPECT_EQ(shell("kill -TERM $$").wait(), 128 + 15);
}

TEST(ChildProcess, OneThatDoesNotReadDoesNoHarm) {
  ChildProcess child = shell("exit 3");
  child.write(std::string(1 << 22, 'x'));  // more than any buffer holds: without a reader, SIGPIPE would end us
  EXPECT_EQ(child.wait(), 3);
}

TEST(ChildProcess, IsKilledWhereNobodyWaits) {
  const auto begin = std::chrono::steady_clock::now();
  { const ChildProcess child = shell("exec sleep 60"); }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(ChildProcess, KeepsWhatItSays) {
  ChildProcess child = shell("echo one >&2; cat >/dev/null; echo two >&2");
  child.write("text");
  EXPECT_EQ(child.wait(), 0);
  EXPECT_EQ(child.errors(), "one\ntwo");
}

/// More than a pipe holds, from a program that reads nothing before all is said.
TEST(ChildProcess, OneThatSaysMuchIsNotStuck) {
  ChildProcess child = shell("head -c 1000000 /dev/zero | tr '\\0' x >&2; cat >/dev/null; exit 5");
  child.write(std::string(1 << 22, 'x'));
  EXPECT_EQ(child.wait(), 5);
  EXPECT_EQ(child.errors().substr(0, 3), "xxx");
}

TEST(ChildProcess, IsGivenUpWhereItHangs) {
  for (const char* script : {"exec sleep 60", "cat >/dev/null; exec sleep 60"}) {
    const auto begin = ChildProcess::Clock::now();
    ChildProcess child({"sh", "-c", script}, [&](ChildProcess::Clock::time_point last_sign) {
      EXPECT_GE(last_sign, begin);
      return ChildProcess::Clock::now() - last_sign > std::chrono::milliseconds(100);
    });
    child.write(std::string(1 << 22, 'x'));
    EXPECT_EQ(child.wait(), 128 + 9);
    EXPECT_TRUE(child.was_given_up());
    EXPECT_LT(ChildProcess::Clock::now() - begin, std::chrono::seconds(30));
  }
}

TEST(ChildProcess, AMissingProgramIsAnError) {
  try {
    ChildProcess child({"no-such-program"});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
}

}  // namespace child_process_test
}  // namespace dspm
