#include "dspm/output/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "dspm/image/animation.h"
#include "dspm/image/encoding.h"
#include "dspm/output/whole_mp4.h"

namespace dspm {
namespace {

constexpr std::chrono::seconds kGrace{5};

int even(int size) { return size + size % 2; }

/// Returns row y, with its last pixel repeated if their number is odd.
Image even_row(const Image& image, int y) {
  Image row(even(image.width), 1);
  for (int x = 0; x < row.width; ++x)
    row.at(x, 0) = image.at(std::min(x, image.width - 1), std::min(y, image.height - 1));
  return row;
}

std::vector<std::string> command(const std::filesystem::path& file, const VideoFormat& format) {
  const float rate = format.frames_per_second > 0 ? format.frames_per_second : kUsualRate;
  // The input is in sRGB. For Y'CbCr, players expect the matrix of BT.709; ffmpeg's default is that of BT.601.
  const std::string input = fmt::format("-pixel_format rgb24 -video_size {}x{} -framerate {} -i pipe:0",
                                        even(format.width), even(format.height), rate);
  std::istringstream words(
      "ffmpeg -hide_banner -loglevel error -xerror -y -f rawvideo " + input +
      " -vf scale=out_color_matrix=bt709:out_range=tv -pix_fmt yuv420p -color_range tv -colorspace bt709"
      " -color_primaries bt709 -color_trc iec61966-2-1 -c:v libx264 -crf 16 -movflags +faststart -f mp4");
  std::vector<std::string> command{std::istream_iterator<std::string>(words), {}};
  command.push_back("file:" + file.string());
  return command;
}

/// Gives ffmpeg some time after its last sign of life, once an end is wanted.
ChildProcess::GiveUp after_grace(Video::EndWanted end_wanted) {
  using Clock = ChildProcess::Clock;
  return [end_wanted = std::move(end_wanted),
          since = std::optional<Clock::time_point>()](Clock::time_point last_sign) mutable {
    if (!end_wanted || !end_wanted()) return false;
    if (!since) since = Clock::now();
    return Clock::now() - std::max(*since, last_sign) > kGrace;
  };
}

}  // namespace

Video::Encoder::Encoder(const std::filesystem::path& path, const VideoFormat& format, ChildProcess::GiveUp give_up)
    : file(path), ffmpeg(command(file.temporary(), format), std::move(give_up)) {}

Video::Video(std::filesystem::path path, const VideoFormat& format, EndWanted end_wanted)
    : path_(std::move(path)), format_(format), end_wanted_(std::move(end_wanted)) {
  const std::unique_ptr<Encoder> trial = encoder([this](auto) { return end_wanted_ && end_wanted_(); });
  const std::string black(static_cast<std::size_t>(even(format.width)) * 3, '\0');
  for (int y = 0; y < even(format.height); ++y) trial->ffmpeg.write(black);
  end(*trial);
}

void Video::add(const Image& shown) {
  if (failure_) return;
  try {
    if (!encoder_) encoder_ = encoder(after_grace(end_wanted_));
  } catch (const std::exception&) {
    failure_ = std::current_exception();
    return;
  }
  for (int y = 0; y < even(shown.height); ++y) encoder_->ffmpeg.write(srgb_bytes(even_row(shown, y)));
}

void Video::finish() {
  if (failure_) std::rethrow_exception(failure_);
  if (!encoder_) return;
  const std::unique_ptr<Encoder> encoder = std::move(encoder_);
  end(*encoder);
  encoder->file.commit();
}

std::unique_ptr<Video::Encoder> Video::encoder(ChildProcess::GiveUp give_up) const {
  try {
    return std::make_unique<Encoder>(path_, format_, std::move(give_up));
  } catch (const std::system_error& error) {
    const bool missing = error.code() == std::errc::no_such_file_or_directory;
    throw WriteError(path_,
                     missing ? "a video needs the program ffmpeg, which is missing; install it, or leave out the video"
                             : fmt::format("the program ffmpeg cannot be run ({}); repair it, or leave out the video",
                                           error.code().message()));
  }
}

void Video::end(Encoder& encoder) {
  const int code = encoder.ffmpeg.wait();
  const auto fail = [&](const std::string& how) { throw WriteError(path_, how); };
  const std::string& said = encoder.ffmpeg.errors();
  if (encoder.ffmpeg.was_given_up()) fail("interrupted while ffmpeg was at work");
  if (code != 0)
    fail(fmt::format("ffmpeg failed with exit code {}, saying: {}", code, said.empty() ? "nothing" : said));
  // Not every error shows in the exit code.
  if (said != always_said_.value_or(said)) fail("ffmpeg failed, saying: " + said);
  if (!is_whole_mp4(encoder.file.temporary())) fail("ffmpeg did not write a complete video");
  always_said_ = said;
}

}  // namespace dspm
