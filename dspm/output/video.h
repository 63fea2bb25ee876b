// Images to a film: H.264 in an .mp4, made by the program ffmpeg, which is no part of dspm.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "dspm/image/image.h"
#include "dspm/output/child_process.h"
#include "dspm/system/atomic_file.h"

namespace dspm {

struct VideoFormat {
  int width = 0, height = 0;    // of the images; the film's are even, as H.264 wants them
  float frames_per_second = 0;  // 0: none was asked for, which makes 24
};

/// The file appears at the end, or not at all.
class Video {
 public:
  /// Whether the user wants an end. Then nobody waits long for an ffmpeg that does not move.
  using EndWanted = std::function<bool()>;

  /// Tries ffmpeg on a black image. Throws WriteError where there is none, where it fails, or where the file
  /// cannot be written: all of that is better known before rendering.
  Video(std::filesystem::path path, const VideoFormat& format, EndWanted end_wanted = {});

  /// The next image, which has been tone mapped. Errors are told by finish().
  void add(const Image& shown);
  /// Writes the file with the images so far; without any, there is none. Throws WriteError.
  void finish();

 private:
  struct Encoder {
    Encoder(const std::filesystem::path& path, const VideoFormat& format, ChildProcess::GiveUp give_up);
    AtomicFile file;
    ChildProcess ffmpeg;
  };
  /// Throws where ffmpeg cannot be run.
  std::unique_ptr<Encoder> encoder(ChildProcess::GiveUp give_up) const;
  /// Waits for it; throws where it failed.
  void end(Encoder& encoder);

  std::filesystem::path path_;
  VideoFormat format_;
  EndWanted end_wanted_;
  std::optional<std::string> always_said_;  // by ffmpeg, in the trial as well: no error
  std::unique_ptr<Encoder> encoder_;        // from the first image on
  std::exception_ptr failure_;              // of its start
};

}  // namespace dspm
