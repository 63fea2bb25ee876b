#include "dspm/output/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <list>
#include <map>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/extension.h"
#include "dspm/base/system/files_read.h"
#include "dspm/base/system/version.h"
#include "dspm/image/image.h"
#include "dspm/image/webp.h"
#include "dspm/integrators/beside/surface_outputs.h"
#include "dspm/output/image_name.h"
#include "dspm/output/manifests.h"
#include "dspm/output/name_template.h"
#include "dspm/output/oidn.h"
#include "dspm/output/trial_writes.h"
#include "dspm/output/write_image.h"
#include "dspm/session/job/developed.h"
#include "dspm/session/job/output_choice.h"

namespace dspm {
namespace {

/// Throws UsageError if a file would replace another one, or one that is read.
void expect_all_distinct(std::vector<NamedFile> written, const OutputSettings& settings, const OtherFiles& others) {
  std::vector<NamedFile> read = others.read;
  expect_distinct({}, read);  // none is given twice
  for (const auto& [path, digest] : files_read()) read.push_back({path, "a file that the scene reads"});
  if (!settings.video.empty()) written.push_back({settings.video, "the video"});
  expect_distinct(read, written);
}

std::vector<std::filesystem::path> paths_of(const std::vector<NamedFile>& files) {
  std::vector<std::filesystem::path> paths;
  for (const NamedFile& file : files) paths.push_back(file.path);
  return paths;
}

/// Transposes the matrix: EXR's matrices act on points as rows.
std::array<float, 16> for_rows(const Matrix4& matrix) {
  std::array<float, 16> all;
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<float>(matrix.m[i % 4][i / 4]);
  return all;
}

}  // namespace

Output::Output(const Job& job, const OutputSettings& settings, const OtherFiles& others, Messages& messages,
               Video::EndWanted end_wanted)
    : job_(job), view_(settings.view), png_(settings.png), layers_(settings) {
  layers_.check(job.outputs);
  if (!settings.contact_sheet.empty()) sheet_.emplace(settings.contact_sheet, job, settings.sheet);
  const std::vector<NamedFile> written = files(settings, others);
  expect_all_distinct(written, settings, others);
  for (const FileFrame frame : settings.images ? job.frames : std::vector<FileFrame>())
    make_folders_of_template(job.film.filename, name(frame));
  try_writes(paths_of(written));
  if (settings.images) {
    if (job.denoiser == Denoiser::oidn) try_oidn(denoised_name(job.frames.front()));
    warn_of_little_space(name(job.frames.front()), bytes_on_disk(), "the images", messages);
  }
  const int width = job.settings.crop.width(), height = job.settings.crop.height();
  if (extension_of(job.film.filename) == ".webp" && std::max(width, height) > kMostOfWebp)
    throw UsageError(fmt::format("{}: WebP images have at most {} pixels a side", job.film.filename, kMostOfWebp));
  const auto variation = [&](FileFrame frame) { return job.description->frames.combination_of(frame); };
  const bool is_one_variation = std::all_of(job.frames.begin(), job.frames.end(), [&](FileFrame frame) {
    return variation(frame) == variation(job.frames.front());
  });
  if (!settings.video.empty() && !is_one_variation)
    throw UsageError("--video shows one variation: choose one with --variation");
  if (!settings.video.empty())
    video_.emplace(settings.video, VideoFormat{width, height, static_cast<float>(job.fps)}, std::move(end_wanted));
}

std::vector<NamedFile> Output::files(const OutputSettings& settings, const OtherFiles& others) const {
  std::vector<NamedFile> files;
  for (const FileFrame frame : settings.images ? job_.frames : std::vector<FileFrame>()) {
    const std::string whose =
        job_.numbered || !job_.variation(frame).empty() ? job_.description->frames.label(frame) + "'s " : "the ";
    const auto add = [&](const std::filesystem::path& image, std::string what) {
      for (const std::filesystem::path& path : with_png(image))
        files.push_back({path, whose + std::exchange(what, "PNG")});
    };
    add(name(frame), "image");
    if (job_.denoiser) add(denoised_name(frame), "denoised image");
    if (!layers_.aov_files) continue;
    for (const std::string& label : file_labels(job_.outputs))
      files.push_back({layer_file(frame, label), whose + "\"" + label + "\""});
  }
  if (settings.stats_in_file()) files.push_back({settings.stats, "the statistics"});
  if (!settings.index.empty()) files.push_back({settings.index, "the table of images"});
  for (const std::filesystem::path& page : sheet_ ? sheet_->names() : std::vector<std::filesystem::path>())
    files.push_back({page, "the contact sheet"});
  files.insert(files.end(), others.written.begin(), others.written.end());
  return files;
}

std::vector<std::filesystem::path> Output::with_png(const std::filesystem::path& image) const {
  std::filesystem::path png = image;
  png.replace_extension(".png");
  if (png_ && extension_of(image) != ".png") return {image, png};
  return {image};
}

std::filesystem::path Output::layer_file(FileFrame frame, const std::string& label) const {
  if (is_template(job_.film.filename)) {
    std::filesystem::path file = name(frame);
    return file.replace_extension("." + label + file.extension().string());
  }
  const std::string& variation = job_.variation(frame);
  return image_name(job_.film.filename, job_.numbered ? std::optional(job_.moment(frame)) : std::nullopt,
                    variation.empty() ? label : fmt::format("{}.{}", variation, label));
}

std::uint64_t Output::bytes_on_disk() const {
  constexpr std::uint64_t kMostOfAnOutput = 12;
  constexpr std::uint64_t kBytes =
      3;  // per pixel of a PNG; HDR adds an exponent; EXR and PFM take two or four for each of them
  std::uint64_t a_pixel = 0;
  for (const std::filesystem::path& file : image_files(job_.frames.front())) {
    const std::string kind = extension_of(file);
    a_pixel += kind == ".png" || kind == ".webp" || kind == ".hdr" ? kBytes + 1
               : kind == ".exr" && job_.film.save_half             ? 2 * kBytes
                                                                   : 4 * kBytes;
  }
  if (job_.denoiser) a_pixel *= 2;
  a_pixel += kMostOfAnOutput * job_.outputs.size();
  return a_pixel * static_cast<std::uint64_t>(job_.settings.crop.count()) * job_.frames.size();
}

std::filesystem::path Output::name(FileFrame frame) const {
  if (is_template(job_.film.filename))
    return filled_in(job_.film.filename, parts_of(job_, frame), job_.moment(frame).number());
  return image_name(job_.film.filename, job_.numbered ? std::optional(job_.moment(frame)) : std::nullopt,
                    job_.variation(frame));
}

std::size_t Output::bytes_while_writing() const {
  // The image, two copies, the last one in the file's format, and the growing file; of other outputs no copies.
  constexpr std::size_t kImages = 6, kLayerImages = 5, kOfTransparency = 3;
  const std::size_t images = kImages + kLayerImages * job_.outputs.size() +
                             (job_.denoiser ? 1 + images_while_denoising(*job_.denoiser) : 0) +
                             (job_.film.transparent ? kOfTransparency : 0);
  return images * static_cast<std::size_t>(job_.settings.crop.count()) * sizeof(Rgb) + (sheet_ ? sheet_->bytes() : 0);
}

ExrHeader Output::header(FileFrame frame, const FrameFigures& figures) const {
  ExrHeader header;
  header.texts = {
      {"scene", job_.scene_file}, {"integrator", job_.integrator}, {"software", fmt::format("dspm {}", kVersion)}};
  header.integers = {{"frame", job_.moment(frame).number()}};
  if (job_.film.transparent) header.integers[kTransparentNumber] = 1;
  if (!job_.variation(frame).empty()) header.texts["variation"] = job_.variation(frame);
  for (std::size_t i = 0; i < job_.description->axes.size(); ++i) {
    const VariationAxis& axis = job_.description->axes[i];
    const Variation& chosen = axis.variations[static_cast<std::size_t>(job_.description->frames.choice(frame, i))];
    if (!axis.name.empty()) header.texts["variation " + axis.name] = chosen.name;
  }
  const std::vector<std::string> groups = light_group_outputs(*job_.description);
  const std::vector<std::string>& outputs = job_.outputs;
  if (std::find(outputs.begin(), outputs.end(), groups.front()) != outputs.end())
    header.texts[kLightGroupsText] = fmt::format("{}", fmt::join(groups, ","));
  header.numbers = {{"seed", static_cast<double>(job_.settings.seed)}};
  header.frames_per_second = job_.fps;
  header.integers["iterations"] = figures.iterations;
  header.numbers["photons"] = static_cast<double>(figures.photons);
  header.numbers["seconds"] = figures.seconds;
  if (figures.error) header.numbers["error"] = *figures.error;
  if (figures.error && figures.radius_in_pixels > 0) header.numbers["radius in pixels"] = figures.radius_in_pixels;
  header.matrices["worldToCamera"] = for_rows(figures.camera.camera_from_world);
  if (figures.camera.image_from_world) header.matrices["worldToNDC"] = for_rows(*figures.camera.image_from_world);
  return header;
}

std::vector<ExrLayer> Output::exr_layers(const std::vector<const OutputLayer*>& layers, ExrHeader& header) const {
  std::vector<ExrLayer> all;
  for (const OutputLayer* layer : layers)
    all.push_back({layer->info.channels, &layer->image, layers_.pixels_of(layer->info, job_.film)});
  add_manifests(layers, header);
  return all;
}

void Output::write(FileFrame frame, Image radiance, const std::vector<OutputLayer>& layers, const FrameFigures& figures,
                   bool alone) {
  ExrFormat format = layers_.exr;
  format.alone = alone;
  const Image image = to_be_shown(std::move(radiance), layers);
  std::list<OutputLayer> parts;  // of radiance
  std::vector<const OutputLayer*> all;
  for (const OutputLayer& layer : layers)
    all.push_back(layer.info.is_radiance ? &parts.emplace_back(OutputLayer{
                                               layer.info, in_film_space(exposed(layer.image, job_), job_.film)})
                                         : &layer);
  ExrHeader header = this->header(frame, figures);
  if (layers_.aov_files) write_apart(frame, all, header, format), all.clear();
  const std::vector<ExrLayer> more = exr_layers(all, header);
  write_views(frame, name(frame), image, header, more, format);
}

void Output::write_denoised(FileFrame frame, Image radiance, const std::vector<OutputLayer>& layers,
                            const FrameFigures& figures) {
  ExrHeader header = this->header(frame, figures);
  header.texts[kDenoised] = name_of(*job_.denoiser);
  std::vector<const OutputLayer*> alpha;
  for (const OutputLayer& layer : layers)
    if (layer.info.name == kAlphaOutput && !layers_.aov_files) alpha.push_back(&layer);
  const std::vector<ExrLayer> more = exr_layers(alpha, header);
  write_views(frame, denoised_name(frame), to_be_shown(std::move(radiance), layers), header, more, layers_.exr);
}

Image Output::to_be_shown(Image radiance, const std::vector<OutputLayer>& layers) const {
  const auto alpha = std::find_if(layers.begin(), layers.end(),
                                  [](const OutputLayer& layer) { return layer.info.name == kAlphaOutput; });
  if (!job_.film.transparent || alpha == layers.end()) return developed(std::move(radiance), job_);
  return with_alpha(std::move(radiance), alpha->image, job_);
}

void Output::write_views(FileFrame frame, const std::filesystem::path& name, const Image& image,
                         const ExrHeader& header, const std::vector<ExrLayer>& more, const ExrFormat& format) {
  if (sheet_) {
    const Image shown = view_.shown(image);
    const std::lock_guard lock(of_sheet_);
    sheet_->put(frame, shown);
  }
  std::exception_ptr failure;
  for (const std::filesystem::path& file : with_png(name)) try {
      write_image(file, image, job_.film, header, view_, more, format);
    } catch (const WriteError&) {
      failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
}

void Output::write_apart(FileFrame frame, const std::vector<const OutputLayer*>& layers, const ExrHeader& header,
                         const ExrFormat& format) const {
  std::map<std::string, std::vector<const OutputLayer*>, std::less<>> files;
  for (const OutputLayer* layer : layers) files[std::string(file_label(layer->info.name))].push_back(layer);
  for (const auto& [label, own] : files) {
    ExrHeader with_manifest = header;
    const std::vector<ExrLayer> all = exr_layers(own, with_manifest);
    write_layers(layer_file(frame, label), all, job_.film, with_manifest, format);
  }
}

void Output::write_contact_sheet() const {
  if (sheet_) sheet_->write(view_.png());
}

void Output::add_to_video(Image radiance, const std::vector<OutputLayer>& layers) {
  if (video_) video_->add(view_.for_video().shown(to_be_shown(std::move(radiance), layers)));
}

void Output::finish_video() {
  if (video_) video_->finish();
}

}  // namespace dspm
