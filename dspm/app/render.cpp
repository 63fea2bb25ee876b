#include "dspm/app/render.h"

#include <chrono>
#include <memory>
#include <utility>

#include "dspm/app/coarse.h"
#include "dspm/app/last_words.h"
#include "dspm/app/progress.h"
#include "dspm/app/signals.h"
#include "dspm/app/watch.h"
#include "dspm/checkpoint/guide_file.h"
#include "dspm/modules/all_plugins.h"
#include "dspm/output/results.h"
#include "dspm/scene/scene.h"
#include "dspm/serve/live_page.h"
#include "dspm/session/explain_photons.h"
#include "dspm/session/out_of_memory.h"
#include "dspm/session/session.h"
#include "dspm/system/memory_use.h"
#include "dspm/system/parallel.h"
#include "dspm/system/readable.h"
#include "dspm/system/standard_streams.h"

namespace dspm {
namespace {

OtherFiles other_files(const Options& options) {
  OtherFiles files;
  for (const std::string& scene : options.scenes)
    if (scene != "-") files.read.push_back({scene, "the scene"});
  if (!options.resume.empty() && (options.checkpoint.empty() || !is_same_file(options.resume, options.checkpoint)))
    files.read.push_back({options.resume, "the checkpoint to resume"});
  if (!options.checkpoint.empty()) files.written.push_back({options.checkpoint, "the checkpoint"});
  if (!options.guide.empty()) files.read.push_back({options.guide, "the guide"});
  if (!options.save_guide.empty()) files.written.push_back({options.save_guide, "the guide"});
  return files;
}

/// Once an integrator has been made, which has learned what it needs.
void keep_guide(const Options& options, const Job& job) {
  if (!options.guide.empty()) expect_guide_is_used(options.guide, job);
  if (!options.save_guide.empty()) save_guide(options.save_guide, job);
}

/// Shows a session's progress, saves its checkpoints and writes its images.
class Render final : public SessionObserver {
 public:
  /// `live`: null if there is no page.
  Render(const LoadedScene& loaded, const Options& options, MemoryBound& memory, Messages& messages, Watch& watch,
         LastWords& last_words, LivePage* live)
      : loaded_(loaded),
        options_(options),
        memory_(memory),
        messages_(messages),
        watch_(watch),
        last_words_(last_words),
        live_(live),
        results_(loaded.job, *loaded.world, options, other_files(options), options.memory == 0, messages,
                 [this] { return end_wanted(); }),
        checkpoints_(loaded.job, options, messages),
        intervals_(memory.plan(loaded.job, *loaded.world, results_.bytes_while_writing(), checkpoints_.intervals(),
                               messages, *this)) {
    report_.threads = thread_count();
  }

  /// Returns the exit code.
  int run();
  const std::vector<FrameList>& intervals() const { return intervals_; }

  void step_begins(const std::string& step, const std::string& who) override {
    watch_.begin(step, who);
    last_words_.begin(step, who);
    if (live_ != nullptr) live_->step_begins(step);
  }
  void ready(const Scene& scene, Integrator& integrator, int iterations) override {
    keep_guide(options_, loaded_.job);
    announce(scene, integrator, iterations);
    if (live_ != nullptr) live_->begin_run(loaded_.job, integrator, iterations, false);
    checkpoints_.begin(intervals_, integrator);
  }
  IntervalProgress interval_begins(std::size_t index, Integrator& integrator) override {
    const IntervalProgress before = checkpoints_.resume(index, integrator);
    progress_->begin(static_cast<int>(index), before.iterations);
    saved_ = before.iterations;
    has_checkpoint_ |= saved_ > 0;
    last_words_.keep(kept_in_words());
    return before;
  }
  void iteration_done(const IntervalProgress& progress, Integrator& integrator) override {
    progress_->step(static_cast<int>(progress.index), progress.iterations, progress.error);
    if (!std::exchange(has_said_what_is_found_, true)) say_what_is_found(integrator.statistics());
    if (checkpoints_.due(progress.iterations)) save(progress, integrator);
    if (live_ != nullptr) show(progress, integrator);
  }
  void images_due(const IntervalProgress& progress, Integrator& integrator, Images images) override {
    if (images == Images::last && progress.iterations > saved_) save(progress, integrator);
    results_.write(intervals_[progress.index], integrator, progress.seconds, images);
    last_words_.keep(kept_in_words());
    if (images == Images::so_far) results_.report_faults();
  }
  void iteration_failed() override { results_.report_missing(); }
  void interval_ends(const IntervalProgress& progress, const Scene& scene, Integrator& integrator) override;
  bool end_wanted() const override {
    return InterruptRequests::signal() != 0 || (live_ != nullptr && live_->end_wanted());
  }
  bool images_wanted() override { return ImageRequests::take() || (live_ != nullptr && live_->images_wanted()); }
  int more_iterations(const IntervalProgress& progress, Integrator& integrator) override;

 private:
  void announce(const Scene& scene, const Integrator& integrator, int iterations);
  Exhibit exhibit(const IntervalProgress& progress, const Integrator& integrator) const {
    return {intervals_[progress.index], integrator, progress.iterations};
  }
  void show(const IntervalProgress& progress, const Integrator& integrator) {
    const Progress::Outlook outlook = progress_->outlook(static_cast<int>(progress.index), progress.iterations);
    live_->iteration_done(progress, exhibit(progress, integrator),
                          {outlook.share, outlook.seconds, outlook.seconds_left});
    watch_.begin("", "");
    live_->wait_while_paused(exhibit(progress, integrator), [this] { return end_wanted(); });
  }
  void say_what_is_found(const Statistics& statistics) {
    for (const EmissionReport& report : statistics.emission) {
      progress_->clear();
      messages_.say("{}", summary_of(report));
    }
  }
  void save(const IntervalProgress& progress, Integrator& integrator) {
    saved_ = progress.iterations;
    results_.attempt(checkpoints_.path(), [&] {
      checkpoints_.save(progress, integrator);
      has_checkpoint_ = !checkpoints_.path().empty();
    });
    results_.report_faults();
    last_words_.keep(kept_in_words());
  }
  /// What a crash would leave.
  std::string kept_in_words() const {
    const std::string images = results_.written();
    std::string words =
        images.empty() ? "no images have been written (--write-every writes some)" : "the images so far: " + images;
    if (has_checkpoint_)
      words += fmt::format("; --resume {} continues from the last checkpoint", checkpoints_.path().string());
    return words;
  }

  const LoadedScene& loaded_;
  const Options& options_;
  const MemoryBound& memory_;
  Messages& messages_;
  Watch& watch_;
  LastWords& last_words_;
  LivePage* live_;
  Results results_;
  Checkpoints checkpoints_;
  std::vector<FrameList> intervals_;
  int saved_ = 0;  // iterations of the interval that the checkpoint holds
  bool has_checkpoint_ = false;
  bool has_said_what_is_found_ = false;
  RunReport report_;
  std::unique_ptr<Progress> progress_;
};

int Render::run() {
  const auto begin = std::chrono::steady_clock::now();
  const double seconds_before = checkpoints_.seconds();
  const SessionSettings settings{options_.time_limit, options_.write_every, results_.bytes_while_writing()};
  Session(loaded_, intervals_, memory_, settings, messages_, *this).run();
  progress_.reset();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  report_.seconds = seconds_before + seconds.count();
  report_.exit_code = InterruptRequests::exit_code(results_.are_whole() ? 0 : 1);
  results_.say_end(report_.seconds, InterruptRequests::signal() != 0);
  if (end_wanted() && !checkpoints_.path().empty())
    messages_.say("--resume {} continues from here", checkpoints_.path().string());
  return InterruptRequests::exit_code(results_.finish(report_) ? 0 : 1);
}

void Render::interval_ends(const IntervalProgress& progress, const Scene& scene, Integrator& integrator) {
  if (progress.index + 1 < intervals_.size()) results_.report_faults();
  if (live_ != nullptr) live_->interval_ends(exhibit(progress, integrator));
  report_.tree_bytes = std::max(report_.tree_bytes, scene.accel->memory());
  report_.add(integrator.statistics(), intervals_[progress.index]);
}

/// With a page, the last interval stays until its user has seen enough.
int Render::more_iterations(const IntervalProgress& progress, Integrator& integrator) {
  if (live_ == nullptr || progress.index + 1 < intervals_.size()) return 0;
  images_due(progress, integrator, Images::so_far);
  messages_.say("the images are written; the page stays, and asks for more or ends the run");
  watch_.begin("", "");  // viewers may take their time
  return live_->wait_for_more(exhibit(progress, integrator), [this] { return end_wanted(); });
}

void Render::announce(const Scene& scene, const Integrator& integrator, int iterations) {
  const Job& job = loaded_.job;
  const PixelRect& crop = job.settings.crop;
  const std::string count = iterations > 0             ? counted(static_cast<std::size_t>(iterations), "iteration")
                            : options_.until_error > 0 ? "iterations"
                                                       : "endless iterations";
  const std::string error =
      options_.until_error > 0 ? fmt::format(" until the error is {}", readable_share(options_.until_error)) : "";
  const std::string limit =
      options_.time_limit > 0 ? fmt::format(", {} at most", readable_time(options_.time_limit)) : "";
  messages_.say("{}: {} of {} x {} pixels, {}, {}{}{}, {}", job.scene_file, job.frames_in_words(), crop.width(),
                crop.height(), job.integrator, count, error, limit,
                counted(static_cast<std::size_t>(thread_count()), "thread"));
  messages_.say("{}: {}", job.integrator, integrator.settings());
  messages_.say("memory before the first iteration: {}, of which trees {}, pixels {}", readable_bytes(peak_memory()),
                readable_bytes(scene.accel->memory()), readable_bytes(integrator.statistics().bytes));
  progress_ = std::make_unique<Progress>(
      Progress::Extent{iterations, options_.time_limit, static_cast<int>(intervals_.size()), options_.until_error},
      options_.quiet);
}

void explain(const LoadedScene& loaded, Render& render, Messages& messages) {
  const auto print = [](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) print_message(fmt::format("{}\n", line));
  };
  for (const FrameList& interval : render.intervals()) print(loaded.world->explain(interval));
  render.step_begins("learning where photons start", in_words("integrator", loaded.job.integrator));
  print(explain_photons(loaded, render.intervals().front(), messages));
}

/// Calls task(render, loaded scene, messages) once all is ready. `step`: names the preparation.
template <class Task>
int with_render(const Options& options, const char* step, const Task& task) {
  const ImageRequests image_requests;
  const ThreadLimit threads(options.threads);
  const std::unique_ptr<LivePage> live = options.serve ? std::make_unique<LivePage>(*options.serve) : nullptr;
  const std::unique_ptr<Messages> own =
      live ? std::make_unique<LiveMessages>(options.quiet, *live) : std::make_unique<Messages>(options.quiet);
  Messages& messages = *own;
  if (live) messages.say("the page is at {}", live->url());
  MemoryBound memory(options.memory);
  Watch watch(options.patience);
  watch.begin(step, "");
  LastWords last_words;
  last_words.begin(step, "");
  return naming_memory_step([&] { return watch.step(); },
                            [&] {
                              if (live) show_coarsely(options, *live, messages);
                              LoadedScene loaded(options.scenes, options, messages);
                              // What only counts must not take memory that was meant for the render.
                              loaded.job.settings.count_found =
                                  (options.explain || !options.stats.empty()) && options.memory == 0;
                              loaded.job.settings.learn_at_once = !options.guide.empty() || !options.save_guide.empty();
                              if (!options.guide.empty()) load_guide(options.guide, loaded.job);
                              const InterruptRequests interrupts;
                              Render render(loaded, options, memory, messages, watch, last_words, live.get());
                              if (options.explain) explain(loaded, render, messages);
                              return task(render, loaded, messages);
                            });
}

}  // namespace

int render_scene(const Options& options) {
  return with_render(options, "reading the scene",
                     [](Render& render, const LoadedScene&, Messages&) { return render.run(); });
}

int check_scene(const Options& options) {
  return with_render(options, "checking the scene", [&](Render&, const LoadedScene& loaded, Messages& messages) {
    const std::unique_ptr<Scene> scene = loaded.world->scene({loaded.job.frames.data(), 1});
    make_integrator(loaded.job, *scene, messages);
    keep_guide(options, loaded.job);
    messages.say("scene ok: {}", summary_of(loaded));
    return 0;
  });
}

}  // namespace dspm
