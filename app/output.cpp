#include "app/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/signals.h"
#include "core/atomic_file.h"
#include "core/version.h"
#include "film/image_name.h"
#include "film/write_image.h"
#include "image/png.h"

namespace dspm {
namespace {

constexpr ToneMap kToneMap{.exposure = 1, .shoulder = true};

/// Makes and removes a file in the same directory.
void expect_writable(const std::filesystem::path& path) { const AtomicFile trial(path); }

}  // namespace

Output::Output(const Job& job, const Options& options)
    : job_(job), png_(options.png), sheet_path_(options.contact_sheet), sheet_places_(job) {
  expect_distinct(files(options));
  const auto longest = std::max_element(job.frames.begin(), job.frames.end(), [&](Frame a, Frame b) {
    return name(a).string().size() < name(b).string().size();  // names may be too long
  });
  expect_writable(name(*longest));
  if (options.stats_in_file()) expect_writable(options.stats);
  const int width = job.settings.crop.width(), height = job.settings.crop.height();
  if (!sheet_path_.empty()) {
    expect_writable(sheet_path_);
    sheet_.emplace(sheet_places_.layout(width, height));
  }
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
  for (const std::string& scene : options.scenes)
    if (scene != "-") files.push_back({scene, "the scene"});
  for (const Frame frame : job_.frames) {
    const std::string whose =
        job_.numbered || !job_.variation(frame).empty() ? job_.description->frames.label(frame) + "'s " : "the ";
    files.push_back({name(frame), whose + "image"});
    std::filesystem::path png = name(frame).replace_extension(".png");
    if (png_ && png != name(frame)) files.push_back({std::move(png), whose + "PNG"});
  }
  if (options.stats_in_file()) files.push_back({options.stats, "the statistics"});
  if (!options.contact_sheet.empty()) files.push_back({options.contact_sheet, "the contact sheet"});
  if (!options.video.empty()) files.push_back({options.video, "the video"});
  return files;
}

std::filesystem::path Output::name(Frame frame) const {
  return image_name(job_.film.filename, job_.numbered ? std::optional(job_.moment(frame)) : std::nullopt,
                    job_.variation(frame));
}

std::size_t Output::bytes_while_writing() const {
  // The image, a copy, both in the file's form, and the file; for the sheet only the latter.
  constexpr std::size_t kImages = 5;
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

void Output::write(Frame frame, Image image, int iterations, std::uint64_t photons, double seconds) {
  for (Rgb& pixel : image.pixels) pixel = pixel * job_.exposure;
  ExrHeader header = this->header(frame);
  header.integers["iterations"] = iterations;
  header.numbers["photons"] = static_cast<double>(photons);
  header.numbers["seconds"] = seconds;
  std::filesystem::path path = name(frame);
  if (sheet_) sheet_->put(sheet_places_.of(frame), shown(image, kToneMap), job_.description->frames.label(frame));
  write_image(path, image, job_.film, header, kToneMap);
  if (png_ && path.extension() != ".png")
    write_image(path.replace_extension(".png"), std::move(image), job_.film, header, kToneMap);
}

void Output::write_contact_sheet() const {
  if (sheet_) write_png(sheet_path_, sheet_->image());
}

void Output::add_to_video(Image image) {
  if (!video_) return;
  for (Rgb& pixel : image.pixels) pixel = limited(pixel * job_.exposure, job_.film.max_component);
  video_->add(shown(std::move(image), kToneMap));
}

void Output::finish_video() {
  if (video_) video_->finish();
}

}  // namespace dspm
