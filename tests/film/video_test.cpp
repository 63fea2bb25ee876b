#include "film/video.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/fake_ffmpeg.h"

namespace dspm {
namespace {

using test::FakeFfmpeg;
using test::TemporaryDirectory;

Image filled(int width, int height, float value) {
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = Rgb(value);
  return image;
}

/// What the constructor or finish() says.
std::string error_of(const std::filesystem::path& path, int images) {
  try {
    Video video(path, {2, 2, 0});
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
  EXPECT_EQ(test::contents(directory / "a.mp4"), "film");
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

TEST(Video, AMissingDirectoryIsSaidAtOnce) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(test::kKeepAll);
  EXPECT_NE(error_of(directory / "none/a.mp4", 0).find("there is no directory"), std::string::npos);
}

}  // namespace
}  // namespace dspm
