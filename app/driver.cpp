#include "app/driver.h"

#include <chrono>
#include <new>

#include "app/catalogue.h"
#include "app/checkpoints.h"
#include "app/frame_intervals.h"
#include "app/job.h"
#include "app/load.h"
#include "app/memory_bound.h"
#include "app/messages.h"
#include "app/out_of_memory.h"
#include "app/progress.h"
#include "app/results.h"
#include "app/run_report.h"
#include "app/signals.h"
#include "app/standard_streams.h"
#include "app/watch.h"
#include "app/write_schedule.h"
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
        integrator_(in_words("integrator", job.integrator)),
        results_(job, world, options, messages),
        checkpoints_(job, options, messages),
        intervals_(memory.plan(job, world, results_.bytes_while_writing(), checkpoints_.intervals(), messages)),
        seconds_before_(checkpoints_.seconds()) {
    report_.threads = thread_count();
  }

  /// All intervals, or until a signal came.
  RunReport render();
  const std::vector<FrameList>& intervals() const { return intervals_; }
  /// The statistics and the video. Whether all files are written.
  bool finish(const RunReport& report) { return results_.finish(report); }

 private:
  void render_interval(std::size_t index);
  /// From where the interval stands up to the last iteration, or until time is up or a signal came.
  void iterate_to_the_end(std::size_t index, Integrator& integrator, int iterations);
  /// Where it throws, the images so far are written; they may hold a part of that iteration. False: it was given up.
  bool iterate(Integrator& integrator, const FrameList& frames, int iteration);
  void announce(const Scene& scene, const Integrator& integrator, int iterations);
  void write(const FrameList& interval, const Integrator& integrator, Results::Images images);
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
  const std::string integrator_;  // as messages name it
  Results results_;
  Checkpoints checkpoints_;
  std::vector<FrameList> intervals_;
  double seconds_before_;        // of the run that is resumed
  double interval_seconds_ = 0;  // of the interval, in runs before this one
  Clock::time_point interval_begin_;
  RunReport report_;
  std::unique_ptr<Progress> progress_;
  Clock::time_point begin_ = Clock::now();
};

RunReport Run::render() {
  for (std::size_t i = 0; i < intervals_.size() && InterruptRequests::signal() == 0; ++i) render_interval(i);
  progress_.reset();
  report_.seconds = seconds_before_ + seconds_since(begin_);
  report_.exit_code = InterruptRequests::exit_code(results_.are_whole() ? 0 : 1);
  results_.say_end(report_.seconds);
  if (InterruptRequests::signal() != 0 && !checkpoints_.path().empty())
    messages_.say("--resume {} goes on from here", checkpoints_.path().string());
  return report_;
}

void Run::render_interval(std::size_t index) {
  watch_.begin("making the scene", "");
  const std::unique_ptr<Scene> scene = world_.scene(intervals_[index]);
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
  iterate_to_the_end(index, *integrator, iterations);
  if (index + 1 < intervals_.size()) results_.tell_faults();
  report_.add(integrator->statistics(), intervals_[index]);
}

void Run::iterate_to_the_end(std::size_t index, Integrator& integrator, int iterations) {
  const FrameList& frames = intervals_[index];
  const double seconds = options_.time_limit > 0 ? time_share(index) : 0;
  const IntervalState before = checkpoints_.resume(index, integrator);
  interval_begin_ = Clock::now(), interval_seconds_ = before.seconds;
  progress_->begin(static_cast<int>(index), before.iterations);
  WriteSchedule schedule(options_.write_every);
  int done = before.iterations, saved = before.iterations;
  if (iterations > 0 && done >= iterations)
    messages_.say("nothing is left of {} iterations; --iterations asks for more", iterations);
  const auto save = [&] {
    saved = done;
    results_.attempt(checkpoints_.path(), [&] { checkpoints_.save(index, done, seconds_of_interval(), integrator); });
    results_.tell_faults();
  };
  const auto finished = [&] {
    return (iterations > 0 && done >= iterations) || InterruptRequests::signal() != 0 ||
           (options_.time_limit > 0 && done > 0 && seconds_since(interval_begin_) >= seconds);
  };
  while (!finished()) {
    watch_.begin(fmt::format("iteration {}", done + 1), integrator_);
    if (!iterate(integrator, frames, done)) break;
    progress_->step(static_cast<int>(index), ++done);
    if (checkpoints_.due(done)) save();
    const bool wanted = ImageRequests::take();
    if (wanted) messages_.say("images of {} iterations were asked for", done);
    if ((schedule.due(done) || wanted) && !finished())
      write(frames, integrator, Results::Images::so_far), results_.tell_faults();
  }
  if (done > saved) save();
  if (done > 0) write(frames, integrator, Results::Images::last);
}

bool Run::iterate(Integrator& integrator, const FrameList& frames, int iteration) {
  constexpr std::size_t kLibraries = 1 << 20;  // what OpenEXR and zlib take besides
  try {
    // Address space only. It is free again in the catch clause, so that images are written even where memory ends.
    const std::unique_ptr<char[]> reserve(new (std::nothrow) char[results_.bytes_while_writing() + kLibraries]);
    asm volatile("" : : "g"(reserve.get()) : "memory");  // else compilers may leave out what nobody uses
    naming_memory_step(watch_, [&] { integrator.iterate(iteration); });
    return true;
  } catch (const Cancelled&) {
    return false;
  } catch (...) {
    if (iteration > 0) write(frames, integrator, Results::Images::so_far);
    results_.tell_missing();
    throw;
  }
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

void Run::write(const FrameList& interval, const Integrator& integrator, Results::Images images) {
  watch_.begin("writing the images", "");
  results_.write(interval, integrator, seconds_of_interval(), images);
}

void explain(const World& world, const std::vector<FrameList>& intervals) {
  for (const FrameList& interval : intervals)
    for (const std::string& line : world.explain(interval)) print_message(fmt::format("{}\n", line));
}

/// Calls task(run, loaded scene, messages) once all is ready. `step`: what comes before.
template <class Task>
int with_run(const Options& options, const char* step, const Task& task) {
  const ImageRequests image_requests;
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
