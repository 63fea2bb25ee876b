#include "dspm/app/run/run.h"

#include <algorithm>
#include <chrono>

#include "dspm/base/system/memory_use.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/readable.h"
#include "dspm/session/checkpoint/guide_file.h"
#include "dspm/session/modules/all_plugins.h"

namespace dspm {

OtherFiles other_files(const Options& options) {
  OtherFiles files;
  for (const std::string& scene : options.scenes)
    if (scene != "-") files.read.push_back({scene, "the scene"});
  for (const std::string& part : options.parts) files.read.push_back({part, "a part"});
  if (!options.resume.empty() && (options.checkpoint.empty() || !is_same_file(options.resume, options.checkpoint)))
    files.read.push_back({options.resume, "the checkpoint to resume"});
  if (!options.checkpoint.empty()) files.written.push_back({options.checkpoint, "the checkpoint"});
  if (!options.guide.empty()) files.read.push_back({options.guide, "the guide"});
  if (!options.save_guide.empty()) files.written.push_back({options.save_guide, "the guide"});
  return files;
}

void keep_guide(const Options& options, const Job& job) {
  if (!options.guide.empty()) expect_guide_is_used(options.guide, job);
  if (!options.save_guide.empty()) save_guide(options.save_guide, job);
}

namespace {

std::vector<FrameList> frames_of(const std::vector<Places>& places) {
  std::vector<FrameList> frames;
  for (const Places& each : places) frames.push_back(each.frames);
  return frames;
}

}  // namespace

Render::Render(const LoadedScene& loaded, const Options& options, const Surroundings& around,
               std::unique_ptr<const CheckpointFile> resumed)
    : loaded_(loaded),
      options_(options),
      memory_(around.memory),
      messages_(around.messages),
      watch_(around.watch),
      last_words_(around.last_words),
      live_(around.live),
      leader_(around.leader),
      results_(loaded.job, *loaded.world, options, other_files(options), options.memory == 0, messages_,
               [this] { return end_wanted(); }),
      checkpoints_(loaded.job, loaded.world->sampling(), options, std::move(resumed), messages_),
      begun_(checkpoints_.begun()),
      intervals_(around.memory.plan(loaded.job, *loaded.world,
                                    {results_.bytes_while_writing() + Onlookers::bytes_at_most(loaded.job, options),
                                     around.leader != nullptr ? Leader::kStates : 0},
                                    frames_of(begun_), messages_, *this)) {
  for (std::size_t i = 0; i < begun_.size(); ++i) intervals_[i] = begun_[i].going_on();
  report_.threads = thread_count();
}

int Render::run() {
  const auto begin = std::chrono::steady_clock::now();
  const double seconds_before = checkpoints_.seconds();
  if (leader_ != nullptr) leader_->expect(digest_of(loaded_.job));
  Session(loaded_, intervals_, memory_, session_settings(), messages_, *this).run();
  onlookers_.reset();
  progress_.reset();
  if (is_of_no_use()) return 0;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  report_.seconds = seconds_before + seconds.count();
  report_.around = loaded_.steps;
  for (const StepTime& step : steps_.end()) report_.around.push_back(step);
  if (leader_ != nullptr) report_.traffic.machines = leader_->machines(), report_.traffic.bytes = leader_->bytes();
  report_.exit_code = InterruptRequests::exit_code(results_.are_whole() ? 0 : 1);
  if (options_.part.is_all())
    results_.say_end(report_.seconds, InterruptRequests::signal() != 0);
  else
    say_end_of_part();
  if (end_wanted() && !checkpoints_.path().empty())
    messages_.say("--resume {} continues from here", checkpoints_.path().string());
  return InterruptRequests::exit_code(results_.finish(report_) ? 0 : 1);
}

SessionSettings Render::session_settings() const {
  SessionSettings settings{options_.time_limit, options_.write_every, results_.bytes_while_writing()};
  settings.part = options_.part, settings.places = begun_;
  if (leader_ == nullptr) return settings;
  settings.block = options_.block.value_or(4);
  settings.share_out = [this, block = settings.block](std::size_t i, Stage& stage,
                                                      std::unique_ptr<Integrator> sum, std::unique_ptr<Integrator> own,
                                                      int all) {
    expect_parts(loaded_.job, *sum, "mpirun");
    return leader_->share_out(std::move(sum), std::move(own), stage, memory_.for_integrator(i), {all, block});
  };
  return settings;
}

void Render::say_end_of_part() const {
  int least = report_.iterations.empty() ? 0 : report_.iterations.front();
  for (const int iterations : report_.iterations) least = std::min(least, iterations);
  messages_.say("{} after {}: {} in {}, {}; --merge writes the images",
                InterruptRequests::signal() != 0 ? "interrupted" : "done", readable_time(report_.seconds),
                options_.part.in_words(), checkpoints_.path().string(),
                counted(static_cast<std::size_t>(least), "iteration"));
}

void Render::interval_ends(const IntervalProgress& progress, const Scene& scene, Integrator& integrator) {
  if (progress.index + 1 < intervals_.size()) results_.report_faults();
  if (live_ != nullptr) live_->interval_ends(exhibit(progress, integrator));
  report_.tree_bytes = std::max(report_.tree_bytes, scene.accel->memory());
  report_.traffic.iterations +=
      static_cast<std::uint64_t>(progress.iterations - resumed_) * intervals_[progress.index].size();
  report_.add(integrator.statistics(), intervals_[progress.index]);
}

/// Keeps the last interval of a run with a page until its user has seen enough.
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
  const std::string part = options_.part.is_all() ? "" : fmt::format(" ({})", options_.part.in_words());
  const std::string machines =
      leader_ == nullptr ? "" : counted(static_cast<std::size_t>(leader_->machines()), "machine") + " and here ";
  messages_.say("{}: {} of {} x {} pixels, {}, {}{}{}{}, {}{}", job.scene_file, job.frames_in_words(), crop.width(),
                crop.height(), job.integrator, count, part, error, limit, machines,
                counted(static_cast<std::size_t>(thread_count()), "thread"));
  messages_.say("{}: {}", job.integrator, integrator.settings());
  messages_.say("memory before the first iteration: {}, of which trees {}, pixels {}", readable_bytes(peak_memory()),
                readable_bytes(scene.accel->memory()), readable_bytes(integrator.statistics().bytes));
  progress_ = std::make_unique<Progress>(
      Progress::Extent{iterations, options_.time_limit, static_cast<int>(intervals_.size()), options_.until_error},
      options_.quiet && options_.progress.empty() ? ProgressKind::none : progress_kind(options_.progress));
}

}  // namespace dspm
