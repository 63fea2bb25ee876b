#include "dspm/base/system/sudden_end.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <list>
#include <vector>

#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/child_process.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

/// The exit code of a process that does this.
template <class Fn>
int exit_code_of(Fn&& fn) {
  const pid_t child = fork();
  if (child == 0) {
    fn();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

TEST(SuddenEnd, LeavesNoTemporaryFileAndNoProgram) {
  const test::TemporaryDirectory directory;
  const int code = exit_code_of([&] {
    AtomicFile committed(directory / "a.txt");
    committed.commit();
    AtomicFile file(directory / "b.txt");
    // Without its input, it would leave a file after a while.
    ChildProcess child({"sh", "-c", "cat; sleep 0.3; touch \"$0\"", (directory / "c.txt").string()});
    end_suddenly(130);
  });
  EXPECT_EQ(code, 130);
  usleep(600'000);
  EXPECT_TRUE(std::filesystem::exists(directory / "a.txt"));
  EXPECT_EQ(directory.file_count(), 1);
}

TEST(SuddenEnd, MoreThanThereIsRoomForDoesNoHarm) {
  const test::TemporaryDirectory directory;
  const int code = exit_code_of([&] {
    for (int round = 0; round < 100; ++round) {
      std::list<AtomicFile> files;
      for (int i = 0; i < 20; ++i) files.emplace_back(directory / std::to_string(i));
    }
    const AtomicFile file(directory / "a.txt");  // all places are free again
    end_suddenly(3);
  });
  EXPECT_EQ(code, 3);
  EXPECT_EQ(directory.file_count(), 0);
}

}  // namespace
}  // namespace dspm
