#include "dspm/output/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/parallel.h"
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

/// The images of a frame, from their estimation to their files.
struct Results::FrameImages {
  FileFrame frame;
  Frame of_interval;
  FrameFigures figures;
  Image image = {}, clean = {};  // clean: with less noise; empty: none
  std::vector<OutputLayer> layers = {};
  std::exception_ptr failure = nullptr;
};

// Several images keep more threads busy than one image's rows. If memory is bounded, there is room for one image.
std::size_t Results::images_at_once(std::size_t count) const {
  constexpr std::size_t kRoom = std::size_t{256} << 20, kRowsOfAThread = 128;
  const auto threads = static_cast<std::size_t>(thread_count());
  if (!keep_failed_ || job_.denoiser || threads == 1) return 1;
  const std::size_t rows = static_cast<std::size_t>(job_.settings.crop.height()),
                    at_once = std::min(count, kRoom / std::max<std::size_t>(1, output_.bytes_while_writing()));
  return at_once >= std::min(rows / kRowsOfAThread, threads) ? std::max<std::size_t>(1, at_once) : 1;
}

void Results::write(const FrameList& interval, const Integrator& integrator, double seconds, Images images) {
  const Statistics statistics = integrator.statistics();
  report_rejections(statistics.rejections, world_, interval, job_, messages_);
  if (!settings_.images) return;
  faults_.retry();
  const std::vector<OutputInfo> outputs = asked_outputs(integrator, job_);
  std::vector<Frame> wanted;
  for (std::size_t j = 0; j < interval.size(); ++j)
    if (std::binary_search(job_.frames.begin(), job_.frames.end(), interval[j]))
      wanted.push_back(static_cast<Frame>(j));
  const std::size_t at_once = images_at_once(wanted.size());
  for (std::size_t begin = 0; begin < wanted.size(); begin += at_once) {
    std::vector<std::shared_ptr<FrameImages>> some;
    for (const Frame j : std::span(wanted).subspan(begin, std::min(at_once, wanted.size() - begin))) {
      const auto at = static_cast<std::size_t>(j);
      const FileFrame frame = interval[at];
      const auto of_frame = std::make_shared<FrameImages>(
          FrameImages{frame, j,
                      FrameFigures{statistics.iterations, statistics.photon.paths, seconds, std::nullopt,
                                   statistics.typical.radius_in_pixels, world_.camera_matrices(frame)}});
      if (at < statistics.errors.size()) of_frame->figures.error = statistics.errors[at];
      if (faults_.attempt(output_.name(frame), [&] { estimate(*of_frame, integrator, outputs, images); }))
        some.push_back(of_frame);
    }
    write_files(some, integrator, images);
  }
  faults_.attempt(settings_.contact_sheet, [&] { output_.write_contact_sheet(); });
  std::set_intersection(interval.begin(), interval.end(), job_.frames.begin(), job_.frames.end(),
                        std::inserter(written_, written_.end()));
}

void Results::estimate(FrameImages& of_frame, const Integrator& integrator, const std::vector<OutputInfo>& outputs,
                       Images images) {
  of_frame.image = integrator.estimate(of_frame.of_interval);
  expect_size(of_frame.image, job_);
  of_frame.layers.clear();
  for (const OutputInfo& output : outputs) {
    of_frame.layers.push_back({output, integrator.estimate(of_frame.of_interval, output.name)});
    expect_size(of_frame.layers.back().image, job_);
    black_out_invalid(of_frame.layers.back().image, output, of_frame.frame, job_, messages_);
  }
  black_out_invalid(of_frame.image, radiance_output(), of_frame.frame, job_, messages_);
  if (images == Images::last && !job_.denoiser) output_.add_to_video(of_frame.image, of_frame.layers);
}

void Results::write_files(const std::vector<std::shared_ptr<FrameImages>>& frames, const Integrator& integrator,
                          Images images) {
  const auto write_image = [this](const FrameImages& of, bool alone) {
    output_.write(of.frame, of.image, of.layers, of.figures, alone);
  };
  const bool at_once = frames.size() > 1;
  if (at_once)
    parallel_for(static_cast<std::int64_t>(frames.size()), 1, [&](std::int64_t i) {
      FrameImages& of_frame = *frames[static_cast<std::size_t>(i)];
      try {
        write_image(of_frame, true);
      } catch (...) {
        of_frame.failure = std::current_exception();
      }
    });
  // Later no integrator is left to ask for the last images.
  const bool keep = images == Images::last && keep_failed_;
  const WriteFaults::Failed failed = keep ? WriteFaults::Failed::kept : WriteFaults::Failed::dropped;
  for (const std::shared_ptr<FrameImages>& of_frame : frames) {
    // What failed beside others is tried again alone: there may be enough memory for one.
    if (at_once && of_frame->failure == nullptr)
      faults_.attempt(output_.name(of_frame->frame), [] {});
    else
      faults_.attempt(
          output_.name(of_frame->frame), [=] { write_image(*of_frame, false); }, failed);
    if (!job_.denoiser) continue;
    const std::filesystem::path name = output_.denoised_name(of_frame->frame);
    const auto denoise = [&] {
      of_frame->clean = denoised(*job_.denoiser, of_frame->image, integrator, of_frame->of_interval, name);
      if (images == Images::last) output_.add_to_video(of_frame->clean, of_frame->layers);
    };
    const auto write_clean = [this, of_frame] {
      output_.write_denoised(of_frame->frame, of_frame->clean, of_frame->layers, of_frame->figures);
    };
    if (faults_.attempt(name, denoise)) faults_.attempt(name, write_clean, failed);
  }
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
