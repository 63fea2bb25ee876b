#include "dspm/base/system/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

using test::contents;
using test::put_file;
using test::TemporaryDirectory;

TEST(AtomicFile, AppearsAtCommit) {
  const TemporaryDirectory directory;
  AtomicFile file(directory / "a.txt");
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(std::filesystem::exists(directory / "a.txt"));
  file.commit();
  EXPECT_EQ(contents(directory / "a.txt"), "one two");
  EXPECT_EQ(directory.file_count(), 1);
}

TEST(AtomicFile, WithoutCommitTheOldFileStaysAndNothingIsLeft) {
  const TemporaryDirectory directory;
  put_file(directory / "a.txt", "old");
  const auto abandoned = [&] {
    AtomicFile file(directory / "a.txt");
    file.write("new, but ");
    throw std::runtime_error("something else failed");
  };
  EXPECT_THROW(abandoned(), std::runtime_error);
  EXPECT_EQ(contents(directory / "a.txt"), "old");
  EXPECT_EQ(directory.file_count(), 1);
}

TEST(AtomicFile, ReplacesAFile) {
  const TemporaryDirectory directory;
  put_file(directory / "a.txt", "a long old text");
  write_file(directory / "a.txt", "new");
  EXPECT_EQ(contents(directory / "a.txt"), "new");
}

TEST(AtomicFile, ALinkStaysALink) {
  const TemporaryDirectory directory;
  put_file(directory / "real.txt", "old");
  std::filesystem::create_symlink("real.txt", directory / "link.txt");
  write_file(directory / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link.txt"));
  EXPECT_EQ(contents(directory / "real.txt"), "new");
}

TEST(AtomicFile, ALinkToNothingGetsItsFile) {
  const TemporaryDirectory directory;
  std::filesystem::create_symlink("real.txt", directory / "link.txt");
  std::filesystem::create_symlink("link.txt", directory / "far.txt");
  write_file(directory / "far.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "far.txt"));
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link.txt"));
  EXPECT_EQ(contents(directory / "real.txt"), "new");
}

std::string message_for(const std::filesystem::path& target) {
  try {
    write_file(target, "text");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(AtomicFile, ErrorsNameTheFileAndTheCause) {
  const TemporaryDirectory directory;
  const std::string missing = message_for(directory / "nowhere/a.txt");
  EXPECT_NE(missing.find("nowhere/a.txt"), std::string::npos) << missing;
  EXPECT_NE(missing.find("no directory"), std::string::npos) << missing;
  EXPECT_NE(message_for(directory / "").find("regular"), std::string::npos);
  EXPECT_NE(message_for("/dev/null").find("regular"), std::string::npos);
  std::filesystem::create_symlink("round", directory / "round");
  EXPECT_NE(message_for(directory / "round").find("round: "), std::string::npos);
  std::filesystem::remove(directory / "round");
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(AtomicFile, TheCauseIsKnownByItself) {
  const TemporaryDirectory directory;
  try {
    write_file(directory / "nowhere/a.txt", "text");
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_EQ(error.cause(), "there is no directory " + (directory / "nowhere").string());
    EXPECT_EQ(error.what(), "cannot write " + (directory / "nowhere/a.txt").string() + ": " + error.cause());
  }
}

/// A disk that is full, played by a limit on the size of files.
TEST(AtomicFile, AFullDiskLeavesTheOldFile) {
  const TemporaryDirectory directory;
  put_file(directory / "a.txt", "old");
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 4096;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message = "no error";
  try {
    write_file(directory / "a.txt", std::string(100'000, 'x'));
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find("a.txt"), std::string::npos) << message;
  EXPECT_EQ(contents(directory / "a.txt"), "old");
  EXPECT_EQ(directory.file_count(), 1);
}

/// A process killed at any moment while it writes again and again leaves one whole version.
TEST(AtomicFile, AKilledProcessLeavesAWholeFile) {
  const TemporaryDirectory directory;
  const std::filesystem::path target = directory / "a.txt";
  put_file(target, std::string(200'000, 'a'));
  for (int round = 0; round < 10; ++round) {
    const pid_t child = fork();
    if (child == 0) {
      for (char c = 'a';; c = c == 'z' ? 'a' : static_cast<char>(c + 1)) write_file(target, std::string(200'000, c));
    }
    usleep(static_cast<useconds_t>(3000 + 1700 * round));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const std::string left = contents(target);
    EXPECT_EQ(left, std::string(200'000, left.at(0)));
  }
}

}  // namespace
}  // namespace dspm
