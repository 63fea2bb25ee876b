#include "dspm/output/video.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <stdexcept>

#include "tests/support/fake_ffmpeg.h"

namespace dspm {
namespace video_test {

using test::FakeFfmpeg;
using test::TemporaryDirectory;

Image filled(int width, int height, float value) {
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = Rgb(value);
  return image;
}

/// What the constructor or finish() says. `tried()` is called between the trial and the images.
std::string error_of(
    const std::filesystem::path& path, int images, const Video::EndWanted& end_wanted = {},
    const std::function<void()>& tried = [] {}) {
  try {
    Video video(path, {2, 2, 0}, end_wanted);
    tried();
    for (int i = 0; i < images; ++i) video.add(Image(2, 2));
    video.finish();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Video, HandsTheImagesOver) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(test::kKeepAll);
  Video video(directory / "a.mp4", {2, 2, 23.976f});
  EXPECT_EQ(directory.file_count(), 0);
  video.add(filled(2, 2, 1));
  video.add(filled(2, 2, 0));
  EXPECT_FALSE(std::filesystem::exists(directory / "a.mp4"));
  video.finish();
  EXPECT_EQ(ffmpeg.input(), std::string(12, '\xff') + std::string(12, '\0'));
  EXPECT_NE(ffmpeg.arguments().find("-video_size\n2x2\n-framerate\n23.976\n"), std::string::npos) << ffmpeg.arguments();
  EXPECT_EQ(test::contents(directory / "a.mp4"), test::kFilm);
  EXPECT_EQ(directory.file_count(), 1);
}

TEST(Video, OddSizesRepeatTheLastColumnAndRow) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(test::kKeepAll);
  Video video(directory / "a.mp4", {3, 1, 0});
  Image image(3, 1);
  image.at(2, 0) = Rgb(1);
  video.add(image);
  video.finish();
  const std::string row = std::string(6, '\0') + std::string(6, '\xff');
  EXPECT_EQ(ffmpeg.input(), row + row);
  EXPECT_NE(ffmpeg.arguments().find("-video_size\n4x2\n-framerate\n24\n"), std::string::npos) << ffmpeg.arguments();
}

TEST(Video, WithoutImagesThereIsNone) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(test::kKeepAll);
  Video video(directory / "a.mp4", {2, 2, 0});
  video.finish();
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(Video, WithoutFinishThereIsNone) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(test::kKeepAll);
  { Video(directory / "a.mp4", {2, 2, 0}).add(Image(2, 2)); }
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(Video, AMissingFfmpegIsSaidAtOnce) {
  const TemporaryDirectory directory;
  const FakeFfmpeg none("");
  EXPECT_NE(error_of(directory / "a.mp4", 0).find("install"), std::string::npos);
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(Video, AFfmpegThatFailsIsTriedBefore) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg("exit 3");
  EXPECT_NE(error_of(directory / "a.mp4", 0).find("exit code 3"), std::string::npos);
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(Video, AFailureLaterLeavesTheOldFile) {
  const TemporaryDirectory directory;
  test::put_file(directory / "a.mp4", "old");
  const FakeFfmpeg ffmpeg(test::kFailLate);
  EXPECT_NE(error_of(directory / "a.mp4", 1000).find("exit code 3"), std::string::npos);
  EXPECT_EQ(test::contents(directory / "a.mp4"), "old");
  EXPECT_EQ(directory.file_count(), 1);
}

/// Where the disk is full, some versions of ffmpeg end with exit code 0.
TEST(Video, WhatIsNoWholeFilmLeavesTheOldFile) {
  for (const char* then :
       {"cat >/dev/null; exit 0", "exit 0", "cat >/dev/null; head -c 1000 /dev/zero >\"${last#file:}\"; exit 0",
        "cat >/dev/null; film; echo 'av_interleaved_write_frame(): No space left' >&2; exit 0",
        "cat >/dev/null; rm \"${last#file:}\"; exit 0"}) {
    const TemporaryDirectory directory;
    test::put_file(directory / "a.mp4", "old");
    const FakeFfmpeg ffmpeg(test::only_once(then));
    EXPECT_NE(error_of(directory / "a.mp4", 2).find("cannot write " + (directory / "a.mp4").string()),
              std::string::npos)
        << then;
    EXPECT_EQ(test::contents(directory / "a.mp4"), "old");
    EXPECT_EQ(directory.file_count(), 1);
  }
}

TEST(Video, ErrorsSayWhatFfmpegSays) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(test::only_once("cat >/dev/null; film; echo no space >&2; exit 0"));
  EXPECT_NE(error_of(directory / "a.mp4", 1).find("no space"), std::string::npos);
}

/// Such as what the loader has to say of its libraries.
TEST(Video, WhatIsSaidInTheTrialAsWellIsNoError) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg("echo no version information available >&2\n" + test::kKeepAll);
  EXPECT_EQ(error_of(directory / "a.mp4", 1), "");
  EXPECT_TRUE(std::filesystem::exists(directory / "a.mp4"));
}

TEST(Video, ATrialThatMakesNoFilmFails) {
  const TemporaryDirectory directory;
  for (const char* script : {"exit 0", "cat >/dev/null"}) {
    const FakeFfmpeg ffmpeg(script);
    EXPECT_NE(error_of(directory / "a.mp4", 0).find("did not write a complete video"), std::string::npos);
  }
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(Video, AnFfmpegThatCannotBeRunIsSaidAtOnce) {
  const TemporaryDirectory directory;
  const FakeFfmpeg none("");
  test::put_file(directory / "ffmpeg", "no program");
  std::filesystem::permissions(directory / "ffmpeg", std::filesystem::perms::owner_read);
  setenv("PATH", (directory / "").c_str(), 1);
  const std::string error = error_of(directory / "a.mp4", 0);
  EXPECT_NE(error.find("a.mp4: the program ffmpeg cannot be run"), std::string::npos) << error;
  EXPECT_NE(error.find("leave out"), std::string::npos) << error;
}

/// The error where an end is wanted from the so-manyth moment on: 0, in the trial; 1, when images are being written.
std::string error_when_ended(const std::filesystem::path& path, int images) {
  bool wanted = images == 0;
  return error_of(
      path, images, [&] { return wanted; }, [&] { wanted = true; });
}

TEST(Video, WhereAnEndIsWantedNobodyWaitsForFfmpeg) {
  const TemporaryDirectory directory;
  const auto begin = std::chrono::steady_clock::now();
  {
    const FakeFfmpeg hangs("exec sleep 60");
    EXPECT_NE(error_when_ended(directory / "a.mp4", 0).find("interrupted"), std::string::npos);
  }
  const FakeFfmpeg hangs_later(test::only_once("exec sleep 60"));
  EXPECT_NE(error_when_ended(directory / "a.mp4", 100'000).find("interrupted"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(Video, WhereAnEndIsWantedFfmpegMayFinish) {
  const TemporaryDirectory directory;
  const FakeFfmpeg slow(test::only_once("cat >/dev/null; sleep 0.5; film; exit 0"));
  EXPECT_EQ(error_when_ended(directory / "a.mp4", 2), "");
  EXPECT_EQ(test::contents(directory / "a.mp4"), test::kFilm);
}

TEST(Video, AMissingDirectoryIsSaidAtOnce) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(test::kKeepAll);
  EXPECT_NE(error_of(directory / "none/a.mp4", 0).find("there is no directory"), std::string::npos);
}

}  // namespace video_test
}  // namespace dspm
