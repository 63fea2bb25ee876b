// One run of a session: shows its progress, on a live page as well, saves its checkpoints and writes its images.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dspm/app/options/options.h"
#include "dspm/app/run/last_words.h"
#include "dspm/app/run/onlookers.h"
#include "dspm/app/run/progress.h"
#include "dspm/app/run/signals.h"
#include "dspm/app/run/watch.h"
#include "dspm/base/math/moments.h"
#include "dspm/looking/serve/live_page.h"
#include "dspm/output/results.h"
#include "dspm/output/step_log.h"
#include "dspm/session/can_part.h"
#include "dspm/session/machines/leader.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/session/session.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The parts of the program that a run needs.
struct Surroundings {
  Messages& messages;
  MemoryBound& memory;
  Watch& watch;
  LastWords& last_words;
  LivePage* live = nullptr;      // if there is one
  Leader* leader = nullptr;      // if other machines help
  KeptGeometry* kept = nullptr;  // see WorldOptions
};

/// Returns the files that a run reads and writes besides its images.
OtherFiles other_files(const Options& options);
/// Saves the guide. Call it once an integrator has been made, which has learned what it needs.
void keep_guide(const Options& options, const Job& job);

class Render final : public SessionObserver {
 public:
  /// `resumed` is the checkpoint to go on from, or null.
  Render(const LoadedScene& loaded, const Options& options, const Surroundings& around,
         std::unique_ptr<const CheckpointFile> resumed);

  /// Returns the exit code.
  int run();
  const std::vector<FrameList>& intervals() const { return intervals_; }

  void step_begins(const std::string& step, const std::string& who) override {
    steps_.begin(step.starts_with("iteration") ? kIterations : step);
    watch_.begin(step, who);
    last_words_.begin(step, who);
    if (live_ != nullptr) live_->step_begins(step);
  }
  void ready(const Scene& scene, Integrator& integrator, int iterations) override {
    keep_guide(options_, loaded_.job);
    announce(scene, integrator, iterations);
    onlookers_.emplace(loaded_.job, options_, View(options_.view), messages_);
    if (live_ != nullptr) live_->begin_run(loaded_.job, scene, integrator, iterations, false);
    if (is_part()) expect_parts(loaded_.job, integrator, "--part");
    checkpoints_.begin(intervals_, integrator);
  }
  IntervalProgress interval_begins(std::size_t index, Integrator& integrator) override {
    const IntervalProgress before = checkpoints_.resume(index, integrator);
    progress_->begin(static_cast<int>(index), before.iterations);
    saved_ = resumed_ = before.iterations;
    has_checkpoint_ |= saved_ > 0;
    last_words_.keep(kept_in_words());
    return before;
  }
  void iteration_done(const IntervalProgress& progress, Integrator& integrator) override {
    steps_.begin("between iterations");
    progress_->step(static_cast<int>(progress.index), progress.iterations, progress.error);
    if (!std::exchange(has_said_what_is_found_, true)) say_what_is_found(integrator.statistics());
    if (checkpoints_.due(progress.iterations)) save(progress, integrator);
    look(progress, integrator, false);
    if (live_ != nullptr) show(progress, integrator);
  }
  void images_due(const IntervalProgress& progress, Integrator& integrator, Images images) override {
    if (is_of_no_use()) return;
    if (images == Images::last && progress.iterations > saved_) save(progress, integrator);
    results_.write(intervals_[progress.index], integrator, progress.seconds, images);
    say_what_is_written(progress.index, images == Images::last);
    if (images == Images::last) look(progress, integrator, true);
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
  bool is_part() const { return !options_.part.is_all(); }
  SessionSettings session_settings() const;
  void say_end_of_part() const;
  void announce(const Scene& scene, const Integrator& integrator, int iterations);
  /// Returns whether the run is out of date, because the scene has changed since.
  bool is_of_no_use() const { return live_ != nullptr && live_->is_restarting(); }
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
  void say_what_is_written(std::size_t interval, bool last) {
    std::vector<std::string> frames;
    for (const FileFrame frame : intervals_[interval]) frames.push_back(loaded_.description->frames.label(frame));
    if (progress_ && results_.are_whole()) progress_->written(static_cast<int>(interval), frames, last);
  }
  void say_what_is_found(const Statistics& statistics) {
    for (const EmissionReport& report : statistics.emission) {
      progress_->clear();
      messages_.say("{}", summary_of(report));
    }
  }
  void look(const IntervalProgress& progress, const Integrator& integrator, bool last) {
    if (!onlookers_ || !onlookers_->any()) return;
    progress_->clear();
    onlookers_->look(intervals_[progress.index], integrator, last);
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
  /// Describes what a crash would leave.
  std::string kept_in_words() const {
    const std::string images = results_.written();
    std::string words = !options_.part.is_all() ? "a part writes no images"
                        : images.empty()        ? "no images have been written (--write-every writes some)"
                                                : "the images so far: " + images;
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
  Leader* leader_;
  Results results_;
  Checkpoints checkpoints_;
  std::vector<Places> begun_;  // of the intervals that the resumed run began
  std::vector<FrameList> intervals_;
  int resumed_ = 0, saved_ = 0;  // iterations of the interval that the checkpoint held at first, and holds
  bool has_checkpoint_ = false;
  bool has_said_what_is_found_ = false;
  RunReport report_;
  StepLog steps_;
  std::unique_ptr<Progress> progress_;
  std::optional<Onlookers> onlookers_;
};

}  // namespace dspm
