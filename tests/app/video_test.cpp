// --video, with a script in place of ffmpeg, and with ffmpeg itself where it is installed.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>

#include "dspm/base/system/find_program.h"
#include "dspm/image/encoding.h"
#include "tests/support/fake_ffmpeg.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

constexpr std::size_t kFrameBytes = 12 * 8 * 3;

std::string bytes_of(const TinyDirectory& directory, const std::string& png) {
  return srgb_bytes(read_image(directory / png));
}

TEST(VideoOption, HoldsThePngsInTheirOrder) {
  const TinyDirectory directory;
  const FakeFfmpeg ffmpeg(kKeepAll);
  // sppm renders one frame after the other, three intervals; images are written more than once.
  const Outcome outcome = run(directory, {"tiny.dsc", "--integrator", "sppm", "--photons", "200", "--iterations", "2",
                                          "--png", "--write-every", "1", "--video", "tiny.mp4"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(ffmpeg.input(), bytes_of(directory, "tiny.0001.png") + bytes_of(directory, "tiny.0002.png") +
                                bytes_of(directory, "tiny.0003.png"));
  EXPECT_NE(ffmpeg.arguments().find("-framerate\n25\n"), std::string::npos) << ffmpeg.arguments();
  EXPECT_EQ(contents(directory / "tiny.mp4"), kFilm);
}

TEST(VideoOption, HoldsTheFramesThatAreAskedFor) {
  const TinyDirectory directory;
  const FakeFfmpeg ffmpeg(kKeepAll);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--frames", "2-3", "--png", "--video", "tiny.mp4"}).code, 0);
  EXPECT_EQ(ffmpeg.input(), bytes_of(directory, "tiny.0002.png") + bytes_of(directory, "tiny.0003.png"));
}

TEST(VideoOption, CtrlCLeavesAVideoOfWhatIsWritten) {
  const TinyDirectory directory;
  const FakeFfmpeg ffmpeg(kKeepAll);
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--write-every", "1", "--video", "tiny.mp4"});
  ASSERT_TRUE(appears(directory / "tiny.0003.exr"));
  process.send(SIGINT);
  EXPECT_EQ(process.wait().code, 130);
  EXPECT_EQ(ffmpeg.input().size(), 3 * kFrameBytes);
  EXPECT_TRUE(directory.has("tiny.mp4"));
}

/// The scene and what was said: no image, no part of a video.
constexpr int kNothing = 3;

/// Soon; a process that nobody has waited for yet has ended as well.
bool has_ended(const FakeFfmpeg& ffmpeg) {
  const auto state = [&] {
    const std::string line = contents("/proc/" + std::to_string(std::stoi(ffmpeg.process())) + "/stat");
    return line.empty() ? 'Z' : line[line.rfind(')') + 2];
  };
  for (int i = 0; i < 500 && state() != 'Z'; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return state() == 'Z';
}

TEST(VideoOption, AnEndInTheTrialLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TinyDirectory directory;
    const FakeFfmpeg ffmpeg(kSayProcess + "exec sleep 60");
    const Process process(directory, {"tiny.dsc", "--video", "tiny.mp4"});
    ASSERT_TRUE(appears(ffmpeg.process_file()));
    process.send(signal);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.code, 128 + signal) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    EXPECT_TRUE(has_ended(ffmpeg));
    EXPECT_EQ(directory.file_count(), kNothing);
  }
}

/// Hangs when the images are written.
const std::string kHangLate = only_once(kSayProcess + "exec sleep 60");

TEST(VideoOption, CtrlCEndsAHangingFfmpegAfterAWhile) {
  const TinyDirectory directory;
  const FakeFfmpeg ffmpeg(kHangLate);
  const Process process(directory, {"tiny.dsc", "--video", "tiny.mp4"});
  ASSERT_TRUE(appears(ffmpeg.process_file()));
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("tiny.mp4"), std::string::npos) << outcome.err;
  EXPECT_TRUE(has_ended(ffmpeg));
  EXPECT_EQ(directory.file_count(), kNothing + 3);
}

TEST(VideoOption, TheSecondCtrlCLeavesNoPartOfAVideo) {
  const TinyDirectory directory;
  const FakeFfmpeg ffmpeg(kHangLate);
  const Process process(directory, {"tiny.dsc", "--video", "tiny.mp4"});
  ASSERT_TRUE(appears(ffmpeg.process_file()));
  ASSERT_TRUE(appears(directory / "tiny.0003.exr"));
  process.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  process.send(SIGINT);
  EXPECT_EQ(process.wait().code, 130);
  EXPECT_TRUE(has_ended(ffmpeg));
  EXPECT_EQ(directory.file_count(), kNothing + 3);
}

TEST(VideoOption, AfterTheRenderFfmpegMayFinish) {
  const TinyDirectory directory;
  const FakeFfmpeg ffmpeg(only_once("cat >\"$here/input\"; " + kSayProcess + "sleep 1; film; exit 0"));
  const Process process(directory, {"tiny.dsc", "--video", "tiny.mp4"});
  ASSERT_TRUE(appears(ffmpeg.process_file()));
  process.send(SIGTERM);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 143) << outcome.err;
  EXPECT_EQ(contents(directory / "tiny.mp4"), kFilm);
}

TEST(VideoOption, AMissingFfmpegIsSaidBeforeRendering) {
  const TinyDirectory directory;
  const FakeFfmpeg none("");
  const Outcome outcome = run(directory, {"tiny.dsc", "--video", "tiny.mp4"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("install"), std::string::npos) << outcome.err;
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
}

TEST(VideoOption, AFailureCostsNoImages) {
  const TinyDirectory directory;
  const FakeFfmpeg ffmpeg(kFailLate);
  const Outcome outcome = run(directory, {"tiny.dsc", "--video", "tiny.mp4", "--stats=s.json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("the disk is full"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("tiny.mp4"), std::string::npos) << outcome.err;
  for (const char* name : {"tiny.0001.exr", "tiny.0003.exr", "s.json"}) EXPECT_TRUE(directory.has(name)) << name;
  EXPECT_FALSE(directory.has("tiny.mp4"));
}

TEST(VideoOption, FfmpegTakesEvenASinglePixel) {
  if (find_program("ffmpeg").empty()) GTEST_SKIP() << "ffmpeg is not installed";
  const TinyDirectory directory;
  for (const char* window : {"0,12,0,8", "3,4,3,4"}) {
    const Outcome outcome = run(directory, {"tiny.dsc", "--pixelbounds", window, "--video", "tiny.mp4"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(contents(directory / "tiny.mp4").substr(4, 4), "ftyp");
  }
}

}  // namespace
}  // namespace dspm::test
