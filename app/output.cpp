#include "app/output.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "app/signals.h"
#include "app/trial_writes.h"
#include "core/atomic_file.h"
#include "core/files_read.h"
#include "core/version.h"
#include "film/image_name.h"
#include "film/write_image.h"
#include "image/png.h"

namespace dspm {
namespace {

constexpr ToneMap kToneMap{.exposure = 1, .shoulder = true};

/// No file may take another one's place, nor that of one which is read.
void expect_all_distinct(std::vector<NamedFile> written, const Options& options) {
  std::vector<NamedFile> read;
  for (const std::string& scene : options.scenes)
    if (scene != "-") read.push_back({scene, "the scene"});
  expect_distinct({}, read);  // none is given twice
  for (const auto& [path, digest] : files_read()) read.push_back({path, "a file that the scene reads"});
  if (!options.resume.empty() && (options.checkpoint.empty() || !is_same_file(options.resume, options.checkpoint)))
    read.push_back({options.resume, "the checkpoint to resume"});
  if (!options.video.empty()) written.push_back({options.video, "the video"});
  expect_distinct(read, written);
}

std::vector<std::filesystem::path> paths_of(const std::vector<NamedFile>& files) {
  std::vector<std::filesystem::path> paths;
  for (const NamedFile& file : files) paths.push_back(file.path);
  return paths;
}

}  // namespace

Output::Output(const Job& job, const Options& options, Messages& messages)
    : job_(job), png_(options.png), sheet_path_(options.contact_sheet), sheet_places_(job) {
  const std::vector<NamedFile> written = files(options);
  expect_all_distinct(written, options);
  try_writes(paths_of(written));
  warn_of_little_space(name(job.frames.front()), bytes_on_disk(), "the images", messages);
  const int width = job.settings.crop.width(), height = job.settings.crop.height();
  if (!sheet_path_.empty()) sheet_.emplace(sheet_places_.layout(width, height));
  const bool is_one_variation = job.description->frames.combination_of(job.frames.front()) ==
                                job.description->frames.combination_of(job.frames.back());
  if (!options.video.empty() && !is_one_variation)
    throw UsageError("--video shows one variation: choose it by --variation");
  if (!options.video.empty())
    video_.emplace(options.video, VideoFormat{width, height, static_cast<float>(job.fps)},
                   [] { return InterruptRequests::signal() != 0; });
}

std::vector<NamedFile> Output::files(const Options& options) const {
  std::vector<NamedFile> files;
  for (const Frame frame : job_.frames) {
    const std::string whose =
        job_.numbered || !job_.variation(frame).empty() ? job_.description->frames.label(frame) + "'s " : "the ";
    const char* what = "image";
    for (const std::filesystem::path& path : image_files(frame))
      files.push_back({path, whose + std::exchange(what, "PNG")});
  }
  if (options.stats_in_file()) files.push_back({options.stats, "the statistics"});
  if (!options.contact_sheet.empty()) files.push_back({options.contact_sheet, "the contact sheet"});
  if (!options.checkpoint.empty()) files.push_back({options.checkpoint, "the checkpoint"});
  return files;
}

std::vector<std::filesystem::path> Output::image_files(Frame frame) const {
  std::filesystem::path image = name(frame), png = image;
  png.replace_extension(".png");
  if (png_ && png != image) return {image, png};
  return {image};
}

std::uint64_t Output::bytes_on_disk() const {
  constexpr std::uint64_t kBytes = 3;  // a pixel of a PNG; other images have two or four for each of them
  std::uint64_t a_pixel = 0;
  for (const std::filesystem::path& file : image_files(job_.frames.front()))
    a_pixel += file.extension() == ".png" ? kBytes : kBytes * (job_.film.save_half ? 2 : 4);
  return a_pixel * static_cast<std::uint64_t>(job_.settings.crop.count()) * job_.frames.size();
}

std::filesystem::path Output::name(Frame frame) const {
  return image_name(job_.film.filename, job_.numbered ? std::optional(job_.moment(frame)) : std::nullopt,
                    job_.variation(frame));
}

std::size_t Output::bytes_while_writing() const {
  // The image, two copies, the last in the file's form, and the file as it grows; for the sheet only the latter.
  constexpr std::size_t kImages = 6;
  const std::size_t sheet = sheet_ ? sheet_->image().pixels.size() : 0;
  return (kImages * static_cast<std::size_t>(job_.settings.crop.count()) + sheet) * sizeof(Rgb);
}

ExrHeader Output::header(Frame frame) const {
  ExrHeader header;
  header.texts = {
      {"scene", job_.scene_file}, {"integrator", job_.integrator}, {"version", fmt::format("dspm {}", kVersion)}};
  header.integers = {{"frame", job_.moment(frame) + 1}};
  if (!job_.variation(frame).empty()) header.texts["variation"] = job_.variation(frame);
  for (std::size_t i = 0; i < job_.description->axes.size(); ++i) {
    const VariationAxis& axis = job_.description->axes[i];
    const Variation& chosen = axis.variations[static_cast<std::size_t>(job_.description->frames.choice(frame, i))];
    if (!axis.name.empty()) header.texts["variation " + axis.name] = chosen.name;
  }
  header.numbers = {{"seed", static_cast<double>(job_.settings.seed)}};
  header.frames_per_second = job_.fps;
  return header;
}

Image Output::developed(Image image) const {
  for (Rgb& pixel : image.pixels) pixel = limited(pixel * job_.exposure, job_.film.max_component);
  return image;
}

void Output::write(Frame frame, Image radiance, int iterations, std::uint64_t photons, double seconds) {
  const Image image = developed(std::move(radiance));
  ExrHeader header = this->header(frame);
  header.integers["iterations"] = iterations;
  header.numbers["photons"] = static_cast<double>(photons);
  header.numbers["seconds"] = seconds;
  if (sheet_) sheet_->put(sheet_places_.of(frame), shown(image, kToneMap), job_.description->frames.label(frame));
  std::exception_ptr failure;
  for (const std::filesystem::path& file : image_files(frame)) try {
      write_image(file, image, job_.film, header, kToneMap);
    } catch (const WriteError&) {
      failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
}

void Output::write_contact_sheet() const {
  if (sheet_) write_png(sheet_path_, sheet_->image());
}

void Output::add_to_video(Image radiance) {
  if (video_) video_->add(shown(developed(std::move(radiance)), kToneMap));
}

void Output::finish_video() {
  if (video_) video_->finish();
}

}  // namespace dspm
