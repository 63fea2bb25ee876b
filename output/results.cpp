#include "dspm/output/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/readable.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/image/image.h"
#include "dspm/output/denoised.h"
#include "dspm/output/not_finite.h"
#include "dspm/output/report/image_index.h"
#include "dspm/session/modules/all_plugins.h"

namespace dspm {
namespace {

void write_report(const Job& job, const RunReport& report, const OutputSettings& settings) {
  if (settings.stats == "table") print_message(fmt::format("\n{}", table_of(job, report)));
  if (settings.stats == "-") print_data(json_of(job, report));
  if (settings.stats_in_file()) write_file(settings.stats, json_of(job, report));
}

void expect_size(const Image& image, const Job& job) {
  const PixelRect& crop = job.settings.crop;
  if (image.width != crop.width() || image.height != crop.height())
    throw std::runtime_error(fmt::format("{} gave an image of {} x {} pixels instead of {} x {}",
                                         in_words("integrator", job.integrator), image.width, image.height,
                                         crop.width(), crop.height()));
}

std::vector<OutputInfo> asked_outputs(const Integrator& integrator, const Job& job) {
  std::vector<OutputInfo> outputs;
  const std::vector<std::string>& asked = job.outputs;
  for (const OutputInfo& output : integrator.outputs())
    if (std::find(asked.begin(), asked.end(), output.name) != asked.end()) outputs.push_back(output);
  return outputs;
}

}  // namespace

Results::Results(const Job& job, const World& world, const OutputSettings& settings, const OtherFiles& others,
                 bool keep_failed, Messages& messages, Video::EndWanted end_wanted)
    : job_(job),
      world_(world),
      settings_(settings),
      keep_failed_(keep_failed),
      messages_(messages),
      faults_(messages),
      output_(job, settings, others, messages, std::move(end_wanted)) {}

void Results::write(const FrameList& interval, const Integrator& integrator, double seconds, Images images) {
  const Statistics statistics = integrator.statistics();
  report_rejections(statistics.rejections, world_, interval, job_, messages_);
  if (!settings_.images) return;
  faults_.retry();
  const std::vector<OutputInfo> outputs = asked_outputs(integrator, job_);
  for (std::size_t j = 0; j < interval.size(); ++j) {
    const FileFrame frame = interval[j];
    if (!std::binary_search(job_.frames.begin(), job_.frames.end(), frame)) continue;
    const std::filesystem::path name = output_.name(frame);
    const auto image = std::make_shared<Image>();
    const auto clean = std::make_shared<Image>();  // with less noise; empty: none
    const auto layers = std::make_shared<std::vector<OutputLayer>>();
    const auto estimate = [&] {
      *image = integrator.estimate(static_cast<Frame>(j));
      expect_size(*image, job_);
      layers->clear();
      for (const OutputInfo& output : outputs) {
        layers->push_back({output, integrator.estimate(static_cast<Frame>(j), output.name)});
        expect_size(layers->back().image, job_);
        black_out_invalid(layers->back().image, output, frame, job_, messages_);
      }
      black_out_invalid(*image, radiance_output(), frame, job_, messages_);
      if (images == Images::last && !job_.denoiser) output_.add_to_video(*image, *layers);
    };
    const auto denoise = [&] {
      *clean = denoised(*job_.denoiser, *image, integrator, static_cast<Frame>(j), output_.denoised_name(frame));
      if (images == Images::last) output_.add_to_video(*clean, *layers);
    };
    FrameFigures figures{statistics.iterations,
                         statistics.photon.paths,
                         seconds,
                         std::nullopt,
                         statistics.typical.radius_in_pixels,
                         world_.camera_matrices(frame)};
    if (j < statistics.errors.size()) figures.error = statistics.errors[j];
    const auto write_image = [this, frame, image, layers, figures] { output_.write(frame, *image, *layers, figures); };
    const auto write_clean = [this, frame, clean, layers, figures] {
      output_.write_denoised(frame, *clean, *layers, figures);
    };
    // Later no integrator is left to ask for the last images.
    const bool keep = images == Images::last && keep_failed_;
    const WriteFaults::Failed failed = keep ? WriteFaults::Failed::kept : WriteFaults::Failed::dropped;
    if (!faults_.attempt(name, estimate)) continue;
    faults_.attempt(name, write_image, failed);
    if (job_.denoiser && faults_.attempt(output_.denoised_name(frame), denoise))
      faults_.attempt(output_.denoised_name(frame), write_clean, failed);
  }
  faults_.attempt(settings_.contact_sheet, [&] { output_.write_contact_sheet(); });
  std::set_intersection(interval.begin(), interval.end(), job_.frames.begin(), job_.frames.end(),
                        std::inserter(written_, written_.end()));
}

std::string Results::written() const {
  if (written_.empty()) return "";
  const auto from_to = [&](auto name) {
    const std::string first = name(*written_.begin()).string();
    return written_.size() > 1 ? fmt::format("{} to {}", first, name(*written_.rbegin()).string()) : first;
  };
  const std::string images = from_to([&](FileFrame frame) { return output_.name(frame); });
  if (!job_.denoiser) return images;
  return images + "; with less noise: " + from_to([&](FileFrame frame) { return output_.denoised_name(frame); });
}

std::vector<std::filesystem::path> Results::files() const {
  std::vector<std::filesystem::path> files;
  for (const FileFrame frame : written_) {
    for (const std::filesystem::path& file : output_.image_files(frame)) files.push_back(file);
    if (job_.denoiser) files.push_back(output_.denoised_name(frame));
  }
  return files;
}

void Results::say_end(double seconds, bool interrupted) const {
  const std::size_t left = job_.frames.size() - written_.size();
  const std::string what = interrupted ? "interrupted" : "done";
  const std::string missing = left > 0 ? fmt::format(", {} not begun", counted(left, "frame")) : "";
  if (written_.empty()) return messages_.say("{} before the first iteration; there are no images", what);
  // Not only in this process: parts and a resumed run's earlier iterations count.
  const std::string after = fmt::format("{} after {} of rendering", what, readable_time(seconds));
  if (faults_.any()) return messages_.say("{}, but not all files could be written{}", after, missing);
  messages_.say("{}: {}{}", after, written(), missing);
}

void Results::write_index() const {
  if (settings_.index.empty()) return;
  std::vector<IndexedImage> images;
  for (const FileFrame frame : written_)
    images.push_back({frame, output_.image_files(frame), job_.denoiser ? output_.denoised_name(frame) : ""});
  write_file(settings_.index, image_index(settings_.index, job_, images));
}

bool Results::finish(const RunReport& report) {
  faults_.retry();
  faults_.attempt(settings_.stats == "-" ? "standard output" : settings_.stats,
                  [&] { write_report(job_, report, settings_); });
  faults_.attempt(settings_.index, [&] { write_index(); });
  faults_.attempt(settings_.video, [&] { output_.finish_video(); });
  faults_.report_missing();
  return are_whole();
}

}  // namespace dspm
