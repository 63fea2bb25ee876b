#include "film/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "image/encoding.h"

namespace dspm {
namespace {

constexpr float kUsualRate = 24;

int even(int size) { return size + size % 2; }

/// With its last column and row once more where their number is odd.
Image even_sized(const Image& image) {
  Image padded(even(image.width), even(image.height));
  for (int y = 0; y < padded.height; ++y)
    for (int x = 0; x < padded.width; ++x)
      padded.at(x, y) = image.at(std::min(x, image.width - 1), std::min(y, image.height - 1));
  return padded;
}

std::vector<std::string> command(const std::filesystem::path& file, const VideoFormat& format) {
  const float rate = format.frames_per_second > 0 ? format.frames_per_second : kUsualRate;
  // What comes in are sRGB's numbers. For Y'CbCr players expect the matrix of BT.709; ffmpeg's own is that of BT.601.
  const std::string input = fmt::format("-pixel_format rgb24 -video_size {}x{} -framerate {} -i pipe:0",
                                        even(format.width), even(format.height), rate);
  std::istringstream words(
      "ffmpeg -hide_banner -loglevel error -y -f rawvideo " + input +
      " -vf scale=out_color_matrix=bt709:out_range=tv -pix_fmt yuv420p -color_range tv -colorspace bt709"
      " -color_primaries bt709 -color_trc iec61966-2-1 -c:v libx264 -crf 16 -movflags +faststart -f mp4");
  std::vector<std::string> command{std::istream_iterator<std::string>(words), {}};
  command.push_back("file:" + file.string());
  return command;
}

}  // namespace

Video::Encoder::Encoder(const std::filesystem::path& path, const VideoFormat& format)
    : file(path), ffmpeg(command(file.temporary(), format)) {}

Video::Video(std::filesystem::path path, const VideoFormat& format) : path_(std::move(path)), format_(format) {
  try {
    add(Image(format.width, format.height));
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    throw std::runtime_error(fmt::format(
        "cannot write {}: a video takes the program ffmpeg, and there is none; install it, or leave out the video",
        path_.string()));
  }
  end_encoder();
  encoder_.reset();
}

void Video::add(const Image& shown) {
  if (!encoder_) encoder_.emplace(path_, format_);
  encoder_->ffmpeg.write(srgb_bytes(even_sized(shown)));
}

void Video::finish() {
  if (!encoder_) return;
  end_encoder();
  encoder_->file.commit();
  encoder_.reset();
}

void Video::end_encoder() {
  const int code = encoder_->ffmpeg.wait();
  if (code == 0) return;
  encoder_.reset();
  throw std::runtime_error(
      fmt::format("cannot write {}: ffmpeg failed with exit code {}; what it says stands above", path_.string(), code));
}

}  // namespace dspm
