#include "dspm/app/coarse.h"

#include <algorithm>
#include <chrono>

#include "dspm/app/signals.h"
#include "dspm/params/params.h"
#include "dspm/scene/scene.h"
#include "dspm/session/session.h"
#include "dspm/world/integrator_choice.h"

namespace dspm {
namespace {

constexpr int kIterations = 8;
constexpr double kSeconds = 2;

/// As many per pixel as at the full size.
void thin_photons(Job& job) {
  if (job.plugin == nullptr) return;
  const std::vector<ParamInfo> described = params_of(*job.plugin);
  const auto info = std::find_if(described.begin(), described.end(), [](const auto& i) { return i.name == "photons"; });
  if (info == described.end()) return;
  constexpr int kUsual = 300'000;
  const int photons = integer_of(job.params, "photons", integer_of(job.params, "photonsperiteration", kUsual));
  if (photons < 0) return;  // one per pixel already
  std::erase_if(job.params.params,
                [](const Param& p) { return p.name == "photons" || p.name == "photonsperiteration"; });
  job.params.params.push_back(
      param_of(ParamType::integer, "photons", std::vector<int>{std::max(1, photons / 16)}, job.where));
}

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
  choices.quick = true, choices.iterations = kIterations, choices.until_error = 0;
  auto loaded = std::make_unique<LoadedScene>(options.scenes, choices, messages, std::nullopt, &kept);
  loaded->job.settings.file = nullptr;  // so that nothing is learned
  thin_photons(loaded->job);
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
