// Images to a film: H.264 in an .mp4, made by the program ffmpeg, which is no part of dspm.
#pragma once

#include <filesystem>
#include <optional>

#include "core/atomic_file.h"
#include "core/child_process.h"
#include "image/image.h"

namespace dspm {

struct VideoFormat {
  int width = 0, height = 0;    // of the images; the film's are even, as H.264 wants them
  float frames_per_second = 0;  // 0: none was asked for, which makes 24
};

/// The file appears at the end, or not at all.
class Video {
 public:
  /// Tries ffmpeg on a black image. Throws std::runtime_error where there is none, where it fails, or where the file
  /// cannot be written: all of that is better known before rendering.
  Video(std::filesystem::path path, const VideoFormat& format);

  /// The next image, which has been tone mapped. Errors are told by finish().
  void add(const Image& shown);
  /// Writes the file with the images so far; without any, there is none. Throws std::runtime_error.
  void finish();

 private:
  struct Encoder {
    Encoder(const std::filesystem::path& path, const VideoFormat& format);
    AtomicFile file;
    ChildProcess ffmpeg;
  };
  /// Waits for ffmpeg; throws where it failed.
  void end_encoder();

  std::filesystem::path path_;
  VideoFormat format_;
  std::optional<Encoder> encoder_;  // from the first image on
};

}  // namespace dspm
