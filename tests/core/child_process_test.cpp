#include "core/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <system_error>

#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

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

TEST(ChildProcess, AMissingProgramIsAnError) {
  try {
    ChildProcess child({"no-such-program"});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
}

}  // namespace
}  // namespace dspm
