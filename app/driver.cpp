#include "app/driver.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <set>
#include <utility>

#include "app/catalogue.h"
#include "app/checkpoints.h"
#include "app/frame_intervals.h"
#include "app/job.h"
#include "app/load.h"
#include "app/memory_bound.h"
#include "app/messages.h"
#include "app/not_finite.h"
#include "app/out_of_memory.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/run_report.h"
#include "app/signals.h"
#include "app/standard_streams.h"
#include "app/watch.h"
#include "app/write_faults.h"
#include "app/write_schedule.h"
#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/parallel.h"
#include "world/world.h"

namespace dspm {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::unique_ptr<Integrator> make_integrator(const Job& job, const Scene& scene, Messages& messages,
                                            std::size_t memory = 0) {
  Diagnostics diagnostics;
  std::unique_ptr<Integrator> integrator = job.make_integrator(scene, diagnostics, memory);
  messages.show(diagnostics);
  diagnostics.throw_if_errors();
  return integrator;
}

void write_report(const Job& job, const RunReport& report, const Options& options) {
  if (options.stats == "table") print_message(fmt::format("\n{}", table_of(job, report)));
  if (options.stats == "-") print_data(json_of(job, report));
  if (options.stats_in_file()) write_file(options.stats, json_of(job, report));
}

/// A render: the world's frames through the integrator into files.
class Run {
 public:
  Run(const Job& job, const World& world, const Options& options, MemoryBound& memory, Messages& messages, Watch& watch)
      : job_(job),
        world_(world),
        options_(options),
        memory_(memory),
        messages_(messages),
        watch_(watch),
        faults_(messages),
        output_(job, options, messages),
        checkpoints_(job, options, messages),
        intervals_(memory.plan(job, world, output_.bytes_while_writing(), checkpoints_.intervals(), messages)),
        seconds_before_(checkpoints_.seconds()) {
    report_.threads = thread_count();
  }

  /// All intervals, or until a signal came.
  RunReport render();
  const std::vector<FrameList>& intervals() const { return intervals_; }
  /// The statistics and the video. Whether all files are written.
  bool finish(const RunReport& report);

 private:
  void render_interval(std::size_t index);
  /// Where it throws, the images so far are written; they may hold a part of that iteration. False: it was given up.
  bool iterate(Integrator& integrator, const FrameList& frames, int iteration);
  void say_end();
  void announce(const Scene& scene, const Integrator& integrator, int iterations);
  /// The images of the interval's frames; the last ones go to the video, too.
  void write(const FrameList& interval, const Integrator& integrator, bool last);
  /// Seconds for the interval: an equal share of what the intervals before it left.
  double time_share(std::size_t index) const {
    return (options_.time_limit - seconds_since(begin_)) / static_cast<double>(intervals_.size() - index);
  }

  /// That its frames have taken so far.
  double seconds_of_interval() const { return interval_seconds_ + seconds_since(interval_begin_); }

  const Job& job_;
  const World& world_;
  const Options& options_;
  const MemoryBound& memory_;
  Messages& messages_;
  Watch& watch_;
  WriteFaults faults_;
  Output output_;
  Checkpoints checkpoints_;
  std::vector<FrameList> intervals_;
  double seconds_before_;        // of the run that is resumed
  double interval_seconds_ = 0;  // of the interval, in runs before this one
  Clock::time_point interval_begin_;
  std::set<Frame> written_;  // those that have images, as far as files can be written
  RunReport report_;
  std::unique_ptr<Progress> progress_;
  Clock::time_point begin_ = Clock::now();
};

RunReport Run::render() {
  for (std::size_t i = 0; i < intervals_.size() && InterruptRequests::signal() == 0; ++i) render_interval(i);
  progress_.reset();
  report_.seconds = seconds_before_ + seconds_since(begin_);
  report_.exit_code = InterruptRequests::exit_code(faults_.any() ? 1 : 0);
  say_end();
  return report_;
}

void Run::render_interval(std::size_t index) {
  const FrameList& frames = intervals_[index];
  watch_.begin("making the scene", "");
  const std::unique_ptr<Scene> scene = world_.scene(frames);
  const std::unique_ptr<Integrator> integrator =
      make_integrator(job_, *scene, messages_, memory_.for_integrator(index));
  const int iterations = job_.iterations(*integrator, options_);
  if (iterations == 0 && options_.time_limit == 0 && intervals_.size() > 1)
    throw UsageError(
        fmt::format("{} frame intervals, one after the other, without an end: give --time-limit or --iterations",
                    intervals_.size()));
  if (index == 0) {
    announce(*scene, *integrator, iterations);
    checkpoints_.begin(intervals_, *integrator);
  }
  report_.tree_bytes = std::max(report_.tree_bytes, scene->accel->memory());

  const double seconds = options_.time_limit > 0 ? time_share(index) : 0;
  const IntervalState before = checkpoints_.resume(index, *integrator);
  interval_begin_ = Clock::now(), interval_seconds_ = before.seconds;
  progress_->begin(static_cast<int>(index), before.iterations);
  WriteSchedule schedule(options_.write_every);
  int done = before.iterations, saved = before.iterations;
  const auto save = [&] {
    saved = done;
    faults_.attempt(checkpoints_.path(), [&] { checkpoints_.save(index, done, seconds_of_interval(), *integrator); });
    faults_.tell();
  };
  const auto finished = [&] {
    return (iterations > 0 && done >= iterations) || InterruptRequests::signal() != 0 ||
           (options_.time_limit > 0 && done > 0 && seconds_since(interval_begin_) >= seconds);
  };
  while (!finished()) {
    watch_.begin(fmt::format("iteration {}", done + 1), in_words("integrator", job_.integrator));
    if (!iterate(*integrator, frames, done)) break;
    progress_->step(static_cast<int>(index), ++done);
    if (checkpoints_.due(done)) save();
    const bool wanted = InterruptRequests::take_write_request();
    if ((schedule.due(done) || wanted) && !finished()) write(frames, *integrator, false), faults_.tell();
  }
  if (done > saved) save();
  if (done > 0) write(frames, *integrator, true);
  if (index + 1 < intervals_.size()) faults_.tell();
  report_.add(integrator->statistics(), frames);
}

bool Run::iterate(Integrator& integrator, const FrameList& frames, int iteration) {
  constexpr std::size_t kLibraries = 1 << 20;  // what OpenEXR and zlib take besides
  try {
    // Address space only. It is free again in the catch clause, so that images are written even where memory ends.
    const std::unique_ptr<char[]> reserve(new (std::nothrow) char[output_.bytes_while_writing() + kLibraries]);
    naming_memory_step(watch_, [&] { integrator.iterate(iteration); });
    return true;
  } catch (const Cancelled&) {
    return false;
  } catch (...) {
    if (iteration > 0) write(frames, integrator, false);
    faults_.tell_end();
    throw;
  }
}

void Run::say_end() {
  const std::size_t left = job_.frames.size() - written_.size();
  const std::string what = InterruptRequests::signal() != 0 ? "interrupted" : "done";
  const std::string missing = left > 0 ? fmt::format(", {} frames were not begun", left) : "";
  if (written_.empty()) return messages_.say("{} before the first iteration; nothing was written", what);
  if (faults_.any())
    return messages_.say("{} after {}, but not all could be written{}", what, readable_time(report_.seconds), missing);
  const std::string last = written_.size() > 1 ? " to " + output_.name(*written_.rbegin()).string() : "";
  messages_.say("{} after {}: {}{}{}", what, readable_time(report_.seconds), output_.name(*written_.begin()).string(),
                last, missing);
}

void Run::announce(const Scene& scene, const Integrator& integrator, int iterations) {
  const RenderSettings& s = job_.settings;
  const std::string limit =
      options_.time_limit > 0 ? fmt::format(", {} at most", readable_time(options_.time_limit)) : "";
  messages_.say("{}: {} of {} x {} pixels, {}, {} iterations{}, {} threads", job_.scene_file, job_.frames_in_words(),
                s.crop.width(), s.crop.height(), job_.integrator,
                iterations > 0 ? std::to_string(iterations) : "endless", limit, thread_count());
  messages_.say("{}: {}", job_.integrator, integrator.settings());
  messages_.say("memory before the first iteration: {}, of which trees {}, pixels {}", readable_bytes(peak_memory()),
                readable_bytes(scene.accel->memory()), readable_bytes(integrator.statistics().bytes));
  progress_ = std::make_unique<Progress>(
      Progress::Extent{iterations, options_.time_limit, static_cast<int>(intervals_.size())}, options_.quiet);
}

void Run::write(const FrameList& interval, const Integrator& integrator, bool last) {
  watch_.begin("writing the images", "");
  const Statistics statistics = integrator.statistics();
  tell(statistics.rejections, world_, interval, job_, messages_);
  faults_.retry();
  for (std::size_t j = 0; j < interval.size(); ++j) {
    const Frame frame = interval[j];
    const std::filesystem::path name = output_.name(frame);
    const auto image = std::make_shared<Image>();
    const auto estimate = [&] {
      *image = integrator.estimate(static_cast<Frame>(j));
      black_out_invalid(*image, frame, job_, messages_);
      if (last) output_.add_to_video(*image);
    };
    const auto write_image = [this, frame, image, iterations = statistics.iterations, photons = statistics.photon.paths,
                              seconds = seconds_of_interval()] {
      output_.write(frame, *image, iterations, photons, seconds);
    };
    // Later there is nobody to ask for the last images.
    const bool keep = last && options_.memory == 0;
    if (faults_.attempt(name, estimate))
      faults_.attempt(name, write_image, keep ? WriteFaults::Failed::kept : WriteFaults::Failed::dropped);
  }
  faults_.attempt(options_.contact_sheet, [&] { output_.write_contact_sheet(); });
  written_.insert(interval.begin(), interval.end());
}

bool Run::finish(const RunReport& report) {
  faults_.retry();
  faults_.attempt(options_.stats == "-" ? "standard output" : options_.stats,
                  [&] { write_report(job_, report, options_); });
  faults_.attempt(options_.video, [&] { output_.finish_video(); });
  faults_.tell_end();
  return !faults_.any();
}

void explain(const World& world, const std::vector<FrameList>& intervals) {
  for (const FrameList& interval : intervals)
    for (const std::string& line : world.explain(interval)) print_message(fmt::format("{}\n", line));
}

/// Calls task(run, loaded scene, messages) once all is ready. `step`: what comes before.
template <class Task>
int with_run(const Options& options, const char* step, const Task& task) {
  const ThreadLimit threads(options.threads);
  Messages messages(options.quiet);
  MemoryBound memory(options.memory);
  Watch watch(options.patience);
  watch.begin(step, "");
  return naming_memory_step(watch, [&] {
    const LoadedScene loaded(options, messages);
    const InterruptRequests interrupts;
    Run run(loaded.job, *loaded.world, options, memory, messages, watch);
    if (options.explain) explain(*loaded.world, run.intervals());
    return task(run, loaded, messages);
  });
}

}  // namespace

int render_scene(const Options& options) {
  return with_run(options, "reading the scene", [](Run& run, const LoadedScene&, Messages&) {
    const RunReport report = run.render();
    return InterruptRequests::exit_code(run.finish(report) ? 0 : 1);
  });
}

int check_scene(const Options& options) {
  return with_run(options, "checking the scene", [](Run&, const LoadedScene& loaded, Messages& messages) {
    const std::unique_ptr<Scene> scene = loaded.world->scene({loaded.job.frames.data(), 1});
    make_integrator(loaded.job, *scene, messages);
    messages.say("scene ok: {}", summary_of(loaded));
    return 0;
  });
}

}  // namespace dspm
