#include "dspm/output/sheet_file.h"

#include <algorithm>
#include <string>
#include <utility>

#include "dspm/colour/rgb.h"
#include "dspm/image/animation.h"
#include "dspm/system/extension.h"

namespace dspm {
namespace {

constexpr double kUsualRate = 24, kSecondsOfAVariation = 1;

/// A quick look is judged on a sheet as large as that of the whole render.
SheetStyle enlarged(SheetStyle style, const Job& job, const SheetLayout& full) {
  if (job.quick && style.tile_width == 0) style.tile_width = std::max(full.image_width, job.settings.crop.width());
  return style;
}

}  // namespace

bool is_sheet_name(const std::filesystem::path& path) {
  return extension_of(path) == ".png" || is_animation_name(path);
}

SheetFile::SheetFile(std::filesystem::path path, const Job& job, const SheetStyle& style)
    : path_(std::move(path)), job_(job), places_(job), moves_(is_animation_name(path_)) {
  const SheetLayout layout = layout_of(style);
  int pages = 1;
  if (moves_) pages = places_.columns() > 0 ? places_.columns() : static_cast<int>(job.frames.size());
  pages_.assign(static_cast<std::size_t>(pages), ContactSheet(layout));
}

SheetLayout SheetFile::layout_of(const SheetStyle& style) const {
  const int width = job_.settings.crop.width(), height = job_.settings.crop.height();
  const auto layout = [&](int w, int h, const SheetStyle& with) {
    return moves_ ? SheetLayout(std::max(places_.rows(), 1), w, h, with) : places_.layout(w, h, with);
  };
  return layout(width, height, enlarged(style, job_, layout(kQuickShare * width, kQuickShare * height, style)));
}

void SheetFile::put(FileFrame frame, const Image& shown) {
  const int place = places_.of(frame), columns = places_.columns();
  const std::string label = job_.description->frames.label(frame);
  if (!moves_) return pages_.front().put(place, shown, label);
  const int page = columns > 0 ? place % columns : place;
  pages_[static_cast<std::size_t>(page)].put(columns > 0 ? place / columns : 0, shown, label);
}

void SheetFile::write(const PngFormat& format) const {
  if (!moves_) return write_png(path_, pages_.front().image(), format);
  std::vector<Image> images;
  for (const ContactSheet& page : pages_) images.push_back(page.image());
  const FileFrames& file = job_.description->frames;
  const auto moment = [&](FileFrame frame) { return file.moment_index(frame); };
  const bool is_time = moment(job_.frames.front()) != moment(job_.frames.back());
  const double rate = job_.fps > 0 ? job_.fps : kUsualRate;
  write_animation(path_, images, is_time ? 1 / rate : kSecondsOfAVariation, format);
}

std::size_t SheetFile::bytes() const {
  // A PNG in memory needs as much again; an animation its copies, and their integers.
  return (moves_ ? 3 : 2) * pages_.size() * pages_.front().image().pixels.size() * sizeof(Rgb);
}

}  // namespace dspm
