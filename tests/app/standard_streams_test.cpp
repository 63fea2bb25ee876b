// Standard output and standard error that cannot be written to.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "dspm/image/image.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

TEST(StandardStreams, MessagesThatCannotBeShownEndNothing) {
  for (const char* err : {"/dev/full", ""}) {
    const TinyDirectory directory;
    const Outcome outcome = Process(directory, {"tiny.dsc", "--stats", "--explain"}, "out.txt", err).wait();
    EXPECT_EQ(outcome.code, 0) << "'" << err << "'";
    for (const char* name : kTinyImages) EXPECT_EQ(read_image(directory / name).width, 12) << name;
    EXPECT_EQ(Process(directory, {"none.dsc"}, "out.txt", err).wait().code, 1);
    EXPECT_EQ(Process(directory, {"--nonsense"}, "out.txt", err).wait().code, 2);
  }
}

TEST(StandardStreams, AReaderOfMessagesMayGoAway) {
  const TinyDirectory directory;
  ASSERT_EQ(mkfifo((directory / "pipe").c_str(), 0600), 0);
  const int reader = open((directory / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--time-limit", "1s", "--stats"}, "out.txt",
                        "pipe");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  close(reader);
  EXPECT_EQ(process.wait().code, 0);
}

TEST(StandardStreams, DataThatCannotBeWrittenIsAnError) {
  const TinyDirectory directory;
  for (const char* out : {"/dev/full", ""})
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"tiny.dsc", "--stats=-"}, {"tiny.dsc", "--format"}, {"--list"}, {"--help"}, {"--version"}}) {
      const Outcome outcome = Process(directory, words, out).wait();
      EXPECT_EQ(outcome.code, 1) << words.front();
      EXPECT_NE(outcome.err.find("cannot write standard output"), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace dspm::test
