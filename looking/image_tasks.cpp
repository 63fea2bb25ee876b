#include "dspm/looking/image_tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <stdexcept>

#include "dspm/base/params/errors.h"
#include "dspm/base/system/extension.h"
#include "dspm/base/system/readable.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "dspm/looking/error_figures.h"
#include "dspm/looking/false_colour.h"
#include "dspm/looking/flicker.h"
#include "dspm/looking/flip.h"
#include "dspm/looking/overlap.h"
#include "dspm/looking/shown_file.h"
#include "dspm/session/distinct_files.h"

namespace dspm {
namespace {

constexpr const char* kBlackReference = "none, the mean of the reference is 0";
constexpr float kMostFlicker = 0.1f;  // of a screen's scale, as the brightest false colour

std::string written_by(const ImageTask& task, const std::string& usual, const std::vector<std::string>& read) {
  const std::string name = task.written.empty() ? usual : task.written;
  if (extension_of(name) != ".png") throw UsageError(fmt::format("-o {}: the false colour image is a .png", name));
  std::vector<NamedFile> files;
  for (const std::string& file : read) files.push_back({file, "an image that is read"});
  expect_distinct(files, {{name, "the false colour image"}});
  return name;
}

std::string in_words(const Framing& part) {
  if (part.width == part.full_width && part.height == part.full_height) return "";
  return fmt::format("pixels         {}, {} to {}, {} of {} x {}\n", part.x, part.y, part.x + part.width - 1,
                     part.y + part.height - 1, part.full_width, part.full_height);
}

std::string stem(const std::string& file) { return std::filesystem::path(file).stem().string(); }

}  // namespace

std::string compare_images(const ImageTask& task) {
  if (task.files.size() != 2)
    throw UsageError("--compare takes two images: the reference, and what to compare with it");
  const std::string &first = task.files[0], &second = task.files[1];
  const std::string written = written_by(task, fmt::format("{}-against-{}.png", stem(second), stem(first)), {});
  written_by(task, written, task.files);
  const Image first_image = read_image(first), second_image = read_image(second);
  const Framing of_first = framing_of(first, first_image), of_second = framing_of(second, second_image);
  const Framing common = overlap_of(first, of_first, second, of_second);
  ErrorFigures figures =
      error_figures(cut_out(first_image, of_first, common), cut_out(second_image, of_second, common));
  figures.x += common.x, figures.y += common.y;
  const View view(task.view);
  const Image reference = cut_out(shown_file(first, view), of_first, common);
  const std::vector<float> errors = flip(reference, cut_out(shown_file(second, view), of_second, common));
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.) / static_cast<double>(errors.size());
  write_png(written, false_colours(errors, reference.width));
  return fmt::format(
      "{} against {}\n{}RMSE           {:.6g}\nrelative RMSE  {}\nbias           {}\nlargest error  {:.6g} at "
      "pixel {}, {}\n{}{}"
      "FLIP           {:.6g}, in false colours: {}\n",
      second, first, in_words(common), figures.rmse,
      figures.relative_rmse ? fmt::format("{:.6g}", *figures.relative_rmse) : kBlackReference,
      figures.bias ? fmt::format("{:+.4g}", *figures.bias) : kBlackReference, figures.largest, figures.x, figures.y,
      figures.alpha_rmse ? fmt::format("RMSE of alpha  {:.6g}\n", *figures.alpha_rmse) : "",
      figures.left_out > 0 ? fmt::format("left out       {} not finite\n", counted(figures.left_out, "pixel")) : "",
      mean, written);
}

std::string measure_flicker(const ImageTask& task) {
  const std::string written = written_by(task, "flicker.png", task.files);
  const View view(task.view);
  FlickerMeter meter;
  int width = 0, height = 0;
  for (const std::string& file : task.files) {
    const Image shown = shown_file(file, view);
    if (width > 0 && (shown.width != width || shown.height != height))
      throw std::runtime_error(fmt::format("{} has {} x {} pixels, and {} has {} x {}", file, shown.width, shown.height,
                                           task.files.front(), width, height));
    width = shown.width, height = shown.height;
    meter.add(shown);
  }
  const Flicker flicker = meter.result();
  write_png(written, false_colours(flicker.rms_of_pixel, width, kMostFlicker));
  return fmt::format(
      "{} frames, of a screen's brightness\nflicker          {:.4g}%\ntypical flicker  {:.4g}%\n"
      "in false colours, up to {}%: {}\n",
      task.files.size(), 100 * flicker.rms, 100 * flicker.typical, 100 * kMostFlicker, written);
}

}  // namespace dspm
