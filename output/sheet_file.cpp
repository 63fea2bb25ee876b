#include "dspm/output/sheet_file.h"

#include <algorithm>
#include <string>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/extension.h"
#include "dspm/image/animation.h"

namespace dspm {
namespace {

constexpr double kSecondsOfAVariation = 1;

/// Enlarges the style for a quick look, which is judged on a sheet as large as that of the whole render.
SheetStyle enlarged(SheetStyle style, const Job& job, const SheetLayout& full) {
  if (job.quick && style.tile_width == 0) style.tile_width = std::max(full.image_width, job.settings.crop.width());
  return style;
}

}  // namespace

bool is_sheet_name(const std::filesystem::path& path) {
  return extension_of(path) == ".png" || is_animation_name(path);
}

SheetFile::SheetFile(std::filesystem::path path, const Job& job, const SheetStyle& style)
    : path_(std::move(path)),
      job_(job),
      moves_(is_animation_name(path_)),
      places_(moves_ ? SheetPlaces(job)
                     : SheetPlaces::suited(job, job.settings.crop.width(), job.settings.crop.height(), style)),
      layout_(layout_of(style)) {
  int images = 1;
  if (moves_) images = places_.columns() > 0 ? places_.columns() : static_cast<int>(job.frames.size());
  sheets_.assign(static_cast<std::size_t>(images), ContactSheet(layout_));
}

SheetLayout SheetFile::layout_of(const SheetStyle& style) const {
  const int width = job_.settings.crop.width(), height = job_.settings.crop.height();
  const auto layout = [&](int w, int h, SheetStyle with) {
    if (!moves_) return places_.layout(w, h, with);
    const int rows = std::max(places_.rows(), 1);
    with.lines = rows;  // what moves in step is on one page
    return SheetLayout(rows, w, h, with);
  };
  return layout(width, height, enlarged(style, job_, layout(kQuickShare * width, kQuickShare * height, style)));
}

std::vector<std::filesystem::path> SheetFile::names() const {
  return moves_ ? std::vector{path_} : page_names(path_, layout_);
}

void SheetFile::put(FileFrame frame, const Image& shown) {
  const int place = places_.of(frame), columns = places_.columns();
  const std::string label = job_.description->frames.label(frame);
  if (!moves_) return sheets_.front().put(place, shown, label);
  const int page = columns > 0 ? place % columns : place;
  sheets_[static_cast<std::size_t>(page)].put(columns > 0 ? place / columns : 0, shown, label);
}

void SheetFile::write(const PngFormat& format) const {
  if (!moves_) return sheets_.front().write(path_, format);
  std::vector<Image> images;
  for (const ContactSheet& sheet : sheets_) images.push_back(sheet.image());
  const FileFrames& file = job_.description->frames;
  const auto moment = [&](FileFrame frame) { return file.moment_index(frame); };
  const bool is_time = moment(job_.frames.front()) != moment(job_.frames.back());
  const double rate = job_.fps > 0 ? job_.fps : kUsualRate;
  write_animation(path_, images, is_time ? 1 / rate : kSecondsOfAVariation, format);
}

std::size_t SheetFile::bytes() const {
  // A PNG in memory needs as much again; an animation its copies, and their integers.
  const std::size_t pages = sheets_.size() * static_cast<std::size_t>(layout_.pages);
  return (moves_ ? 3 : 2) * pages * sheets_.front().image().pixels.size() * sizeof(Rgb);
}

}  // namespace dspm
