#include "app/results.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "app/catalogue.h"
#include "app/not_finite.h"
#include "app/progress.h"
#include "app/signals.h"
#include "app/standard_streams.h"
#include "core/atomic_file.h"

namespace dspm {
namespace {

void write_report(const Job& job, const RunReport& report, const Options& options) {
  if (options.stats == "table") print_message(fmt::format("\n{}", table_of(job, report)));
  if (options.stats == "-") print_data(json_of(job, report));
  if (options.stats_in_file()) write_file(options.stats, json_of(job, report));
}

void expect_size(const Image& image, const Job& job) {
  const PixelRect& crop = job.settings.crop;
  if (image.width != crop.width() || image.height != crop.height())
    throw std::runtime_error(fmt::format("{} gave an image of {} x {} pixels, and {} x {} were asked for",
                                         in_words("integrator", job.integrator), image.width, image.height,
                                         crop.width(), crop.height()));
}

}  // namespace

Results::Results(const Job& job, const World& world, const Options& options, Messages& messages)
    : job_(job),
      world_(world),
      options_(options),
      messages_(messages),
      faults_(messages),
      output_(job, options, messages) {}

void Results::write(const FrameList& interval, const Integrator& integrator, double seconds, Images images) {
  const Statistics statistics = integrator.statistics();
  tell(statistics.rejections, world_, interval, job_, messages_);
  faults_.retry();
  for (std::size_t j = 0; j < interval.size(); ++j) {
    const Frame frame = interval[j];
    const std::filesystem::path name = output_.name(frame);
    const auto image = std::make_shared<Image>();
    const auto estimate = [&] {
      *image = integrator.estimate(static_cast<Frame>(j));
      expect_size(*image, job_);
      black_out_invalid(*image, frame, job_, messages_);
      if (images == Images::last) output_.add_to_video(*image);
    };
    const auto write_image = [this, frame, image, seconds, iterations = statistics.iterations,
                              photons = statistics.photon.paths] {
      output_.write(frame, *image, iterations, photons, seconds);
    };
    // Later there is nobody to ask for the last images.
    const bool keep = images == Images::last && options_.memory == 0;
    if (faults_.attempt(name, estimate))
      faults_.attempt(name, write_image, keep ? WriteFaults::Failed::kept : WriteFaults::Failed::dropped);
  }
  faults_.attempt(options_.contact_sheet, [&] { output_.write_contact_sheet(); });
  written_.insert(interval.begin(), interval.end());
}

void Results::say_end(double seconds) const {
  const std::size_t left = job_.frames.size() - written_.size();
  const std::string what = InterruptRequests::signal() != 0 ? "interrupted" : "done";
  const std::string missing = left > 0 ? fmt::format(", {} frames were not begun", left) : "";
  if (written_.empty()) return messages_.say("{} before the first iteration; there are no images", what);
  if (faults_.any())
    return messages_.say("{} after {}, but not all could be written{}", what, readable_time(seconds), missing);
  const std::string last = written_.size() > 1 ? " to " + output_.name(*written_.rbegin()).string() : "";
  messages_.say("{} after {}: {}{}{}", what, readable_time(seconds), output_.name(*written_.begin()).string(), last,
                missing);
}

bool Results::finish(const RunReport& report) {
  faults_.retry();
  faults_.attempt(options_.stats == "-" ? "standard output" : options_.stats,
                  [&] { write_report(job_, report, options_); });
  faults_.attempt(options_.video, [&] { output_.finish_video(); });
  faults_.tell_end();
  return are_whole();
}

}  // namespace dspm
