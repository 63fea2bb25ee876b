// A contact sheet and a video of images that exist.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/system/extension.h"
#include "dspm/base/system/readable.h"
#include "dspm/image/animation.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "dspm/image/shrink.h"
#include "dspm/looking/image_tasks.h"
#include "dspm/looking/shown_file.h"
#include "dspm/output/video.h"
#include "dspm/session/distinct_files.h"

namespace dspm {
namespace {

/// Fits an image into that size, on black if its shape is another one.
Image fitted(const Image& image, int width, int height) {
  if (static_cast<long>(image.width) * height == static_cast<long>(image.height) * width) return image;
  const double share = std::min(static_cast<double>(width) / image.width, static_cast<double>(height) / image.height);
  const int w = std::max(1, static_cast<int>(std::lround(image.width * share))),
            h = std::max(1, static_cast<int>(std::lround(image.height * share)));
  const Image small = shrunk(image, w, h);
  Image page(width, height);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) page.at(x + (width - w) / 2, y + (height - h) / 2) = small.at(x, y);
  return page;
}

double rate_of(const PageFiles& pages, const std::string& first) {
  if (pages.fps > 0) return pages.fps;
  double rate = 0;
  if (extension_of(first) == ".exr") rate = read_exr_header(first).frames_per_second;
  return rate > 0 ? rate : kUsualRate;
}

void check_files(const ImageTask& task, const PageFiles& pages, const std::vector<std::filesystem::path>& sheets) {
  std::vector<NamedFile> read, written;
  for (const std::string& file : task.files)
    if (std::none_of(read.begin(), read.end(), [&](const NamedFile& each) { return each.path == file; }))
      read.push_back({file, "an image that is read"});
  for (const std::filesystem::path& sheet : sheets) written.push_back({sheet, "the sheet"});
  if (!pages.video.empty()) written.push_back({pages.video, "the video"});
  expect_distinct(read, written);
}

/// Puts all images on one sheet; if it moves, each on a sheet of its own.
class Sheets {
 public:
  Sheets(std::string path, std::size_t count, const Image& first, const SheetStyle& style)
      : path_(std::move(path)),
        moves_(is_animation_name(path_)),
        width_(first.width),
        height_(first.height),
        layout_(moves_ ? 1 : static_cast<int>(count), width_, height_, style),
        sheet_(layout_) {}
  std::vector<std::filesystem::path> names() const {
    return moves_ ? std::vector<std::filesystem::path>{path_} : page_names(path_, layout_);
  }

  void put(std::size_t i, const Image& image, const std::string& label) {
    const Image fitting = fitted(image, width_, height_);
    if (!moves_) return sheet_.put(static_cast<int>(i), fitting, label);
    ContactSheet page(layout_);
    page.put(0, fitting, label);
    pages_.push_back(page.image());
  }
  void write(const PngFormat& format, double rate) const {
    if (moves_) return write_animation(path_, pages_, 1 / rate, format);
    sheet_.write(path_, format);
  }

 private:
  std::string path_;
  bool moves_;
  int width_, height_;
  SheetLayout layout_;
  ContactSheet sheet_;
  std::vector<Image> pages_;
};

}  // namespace

std::string make_pages(const ImageTask& task, const PageFiles& pages) {
  if (pages.sheet.empty() && pages.video.empty())
    throw UsageError("what is to be made of these images? --sheet FILE, --video FILE, --compare or --flicker");
  const View view(task.view), video_view = view.for_video();
  const double rate = rate_of(pages, task.files.front());
  const Image first = shown_file(task.files.front(), view);
  std::unique_ptr<Sheets> sheets;
  std::unique_ptr<Video> video;
  if (!pages.sheet.empty()) sheets = std::make_unique<Sheets>(pages.sheet, task.files.size(), first, pages.style);
  const std::vector<std::filesystem::path> names = sheets ? sheets->names() : std::vector<std::filesystem::path>();
  check_files(task, pages, names);
  if (!pages.video.empty())
    video = std::make_unique<Video>(pages.video, VideoFormat{first.width, first.height, static_cast<float>(rate)});
  for (std::size_t i = 0; i < task.files.size(); ++i) {
    const std::string& file = task.files[i];
    if (sheets) sheets->put(i, shown_file(file, view), std::filesystem::path(file).stem().string());
    if (!video) continue;
    const Image image = shown_file(file, video_view);
    if (image.width != first.width || image.height != first.height)
      throw std::runtime_error(fmt::format(
          "{}: the images of a video have one size, and this one's {} x {} pixels are not the first one's {} x {}",
          file, image.width, image.height, first.width, first.height));
    video->add(image);
  }
  if (sheets) sheets->write(view.png(), rate);
  if (video) video->finish();
  std::vector<std::string> written;
  if (!names.empty()) written.push_back(names.front().string());
  if (names.size() > 1) written.back() += " to " + names.back().string();
  if (video) written.push_back(pages.video);
  return fmt::format("{}: {}\n", counted(task.files.size(), "image"), fmt::join(written, ", "));
}

}  // namespace dspm
