#include "dspm/app/run/coarse.h"

#include "dspm/app/run/signals.h"
#include "dspm/session/job/integrator_choice.h"
#include "dspm/session/session.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr int kCoarseIterations = 8;
constexpr double kSeconds = 2;

class CoarseView final : public SessionObserver {
 public:
  CoarseView(const LoadedScene& loaded, const std::vector<FrameList>& intervals, LivePage& page)
      : loaded_(loaded), intervals_(intervals), page_(page) {}

  void ready(const Scene& scene, Integrator& integrator, int iterations) override {
    page_.begin_run(loaded_.job, scene, integrator, iterations, true);
  }
  void iteration_done(const IntervalProgress& progress, Integrator& integrator) override {
    page_.iteration_done(progress, {intervals_[progress.index], integrator, progress.iterations},
                         {0, progress.seconds, std::nullopt});
  }
  void interval_ends(const IntervalProgress& progress, const Scene&, Integrator& integrator) override {
    page_.interval_ends({intervals_[progress.index], integrator, progress.iterations});
  }
  bool end_wanted() const override { return page_.end_wanted() || InterruptRequests::signal() != 0; }

 private:
  const LoadedScene& loaded_;
  const std::vector<FrameList>& intervals_;
  LivePage& page_;
};

}  // namespace

std::unique_ptr<LoadedScene> load_coarsely(const Options& options, Messages& messages, KeptGeometry& kept) {
  Choices choices = options;
  choices.quick = true, choices.iterations = kCoarseIterations, choices.until_error = 0;
  if (choices.photons) choices.photons = quick_photons(*choices.photons);
  auto loaded = std::make_unique<LoadedScene>(options.scenes, choices, messages, std::nullopt, &kept);
  loaded->job.settings.file = nullptr;  // so that nothing is learned
  return loaded;
}

void show_coarsely(const LoadedScene& loaded, LivePage& page) {
  const std::vector<FrameList> intervals =
      FrameIntervals(*loaded.description, loaded.job.frames).cut(loaded.job.plugin->frames_together);
  MemoryBound memory(0);
  CoarseView view(loaded, intervals, page);
  page.step_begins("coarse iterations");
  SessionSettings settings;
  settings.time_limit = kSeconds;
  Messages quiet(true);
  Session(loaded, intervals, memory, settings, quiet, view).run();
}

}  // namespace dspm
