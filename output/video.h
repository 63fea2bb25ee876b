// Makes a film of images: H.264 in an .mp4, by the program ffmpeg, which dspm does not include.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/child_process.h"
#include "dspm/image/image.h"

namespace dspm {

struct VideoFormat {
  int width = 0, height = 0;    // of the images; the film's are even, as H.264 requires
  float frames_per_second = 0;  // 0: not given, which means 24
};

/// The file appears at the end, or not at all.
class Video {
 public:
  /// Returns whether the user wants an end. If so, nothing waits long for an ffmpeg that hangs.
  using EndWanted = std::function<bool()>;

  /// Tries ffmpeg on a black image, to find errors before rendering. Throws WriteError if there is no ffmpeg, if it
  /// fails, or if the file cannot be written.
  Video(std::filesystem::path path, const VideoFormat& format, EndWanted end_wanted = {});

  /// Adds the next image, which has been tone mapped. Errors are reported by finish().
  void add(const Image& shown);
  /// Writes the file with the images so far; without images, there is no file. Throws WriteError.
  void finish();

 private:
  struct Encoder {
    Encoder(const std::filesystem::path& path, const VideoFormat& format, ChildProcess::GiveUp give_up);
    AtomicFile file;
    ChildProcess ffmpeg;
  };
  /// Throws if ffmpeg cannot be run.
  std::unique_ptr<Encoder> encoder(ChildProcess::GiveUp give_up) const;
  /// Waits for it; throws if it failed.
  void end(Encoder& encoder);

  std::filesystem::path path_;
  VideoFormat format_;
  EndWanted end_wanted_;
  std::optional<std::string> always_said_;  // by ffmpeg, even in the trial: not an error
  std::unique_ptr<Encoder> encoder_;        // from the first image on
  std::exception_ptr failure_;              // of its start
};

}  // namespace dspm
