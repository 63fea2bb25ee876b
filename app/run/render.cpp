#include "dspm/app/run/render.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "dspm/app/run/render_live.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/base/system/work.h"
#include "dspm/session/checkpoint/changes.h"
#include "dspm/session/checkpoint/guide_file.h"
#include "dspm/session/explain_intervals.h"
#include "dspm/session/explain_photons.h"
#include "dspm/session/exposure.h"
#include "dspm/session/job/frame_choice.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/session/out_of_memory.h"
#include "dspm/session/stage.h"

namespace dspm {
namespace {

void explain(const LoadedScene& loaded, Render& render, Messages& messages) {
  const auto print = [](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) print_message(fmt::format("{}\n", line));
  };
  print(explain_intervals(*loaded.world, render.intervals()));
  print(explain_shutter(loaded.job));
  render.step_begins("learning where photons start", in_words("integrator", loaded.job.integrator));
  print(explain_photons(loaded, render.intervals().front(), messages));
}

/// Renders new frames as far as the frames that were there, unless something else was asked for.
void go_as_far(const CheckpointFile& resumed, Job& job) {
  int most = 0;
  for (const IntervalState& state : resumed.intervals()) most = std::max(most, state.iterations);
  if (most > 0 && !job.chosen_iterations && job.until_error == 0) job.chosen_iterations = most;
}

/// A scene that was edited since may be why somebody asks for what is new: the error says what was edited.
[[noreturn]] void say_what_changed(const Options& options, const CheckpointFile& resumed, const Surroundings& around,
                                   const NothingNew& nothing) {
  Choices all = choices_of(options, &resumed);
  all.only_new = false, all.frames.clear(), all.variations.clear();
  LoadedScene loaded(options.scenes, all, around.messages, std::nullopt, around.kept);
  prepare(options, &resumed, around.leader != nullptr, loaded.job);
  const Changes changes(loaded.job, resumed.render(), loaded.world->sampling());
  if (changes.any()) changes.refuse_only_new(around.messages);
  throw nothing;
}

LoadedScene scene_to_render(const Options& options, const CheckpointFile* resumed, const Surroundings& around) try {
  return LoadedScene(options.scenes, choices_of(options, resumed), around.messages, std::nullopt, around.kept);
} catch (const NothingNew& nothing) {
  say_what_changed(options, *resumed, around, nothing);
}

/// The same, with surroundings of its own.
int with_render(const Options& options, const char* step, Link* others,
                const std::function<int(Render&, const LoadedScene&, Messages&)>& task) {
  const ImageRequests image_requests;
  const ThreadLimit threads(options.threads);
  Messages messages(options.quiet);
  MemoryBound memory(options.memory);
  Watch watch(options.patience);
  watch.begin(step, "");
  LastWords last_words;
  last_words.begin(step, "");
  std::optional<InterruptRequests> interrupts;
  std::optional<Leader> leader;
  if (others != nullptr)
    leader.emplace(
        *others, [] { return InterruptRequests::signal() != 0; }, options.longest_silence());
  const int code = naming_memory_step(
      [&] { return watch.step(); },
      [&] {
        return load_and(
            options, {messages, memory, watch, last_words, nullptr, leader ? &*leader : nullptr},
            [&] { interrupts.emplace(); },
            [&](Render& render, const LoadedScene& loaded) { return task(render, loaded, messages); });
      });
  if (leader) leader->end();
  return code;
}

}  // namespace

std::unique_ptr<const CheckpointFile> file_to_resume(const Options& options) {
  return options.resume.empty() ? nullptr : std::make_unique<const CheckpointFile>(options.resume);
}

Choices choices_of(const Options& options, const CheckpointFile* resumed) {
  Choices choices = options;
  if (resumed != nullptr) choices.known = resumed->render().frames;
  return choices;
}

void prepare(const Options& options, const CheckpointFile* resumed, bool together, Job& job) {
  take_part_of_frames(options.frame_part, job);
  if (options.only_new && resumed != nullptr) go_as_far(*resumed, job);
  // What only counts must not take memory that was meant for the render.
  job.settings.count_found = (options.explain || !options.stats.empty()) && options.memory == 0;
  job.settings.learn_at_once = together || !options.guide.empty() || !options.save_guide.empty();
  if (!options.guide.empty()) load_guide(options.guide, job);
}

void take_part_of_frames(const Part& part, Job& job) {
  if (part.is_all()) return;
  const std::vector<FrameList> all = FrameIntervals(*job.description, job.frames).deal(part.of);
  if (static_cast<std::size_t>(part.number) > all.size())
    throw UsageError(fmt::format("--part frames:{}/{}: the frames make only {} parts that share what they can",
                                 part.number, part.of, all.size()));
  job.frames = all[static_cast<std::size_t>(part.number) - 1];
}

int load_and(const Options& options, const Surroundings& around, const std::function<void()>& before,
             const std::function<int(Render&, const LoadedScene&)>& task) {
  std::unique_ptr<const CheckpointFile> resumed = file_to_resume(options);
  if (!options.stats.empty()) count_work();
  LoadedScene loaded = scene_to_render(options, resumed.get(), around);
  prepare(options, resumed.get(), around.leader != nullptr, loaded.job);
  before();
  Render render(loaded, options, around, std::move(resumed));
  if (options.explain) explain(loaded, render, around.messages);
  return task(render, loaded);
}

int render_scene(const Options& options, Link* others) {
  if (options.serve) return render_live(options, others);
  return with_render(options, "reading the scene", others,
                     [](Render& render, const LoadedScene&, Messages&) { return render.run(); });
}

int check_scene(const Options& options) {
  return with_render(options, "checking the scene", nullptr,
                     [&](Render&, const LoadedScene& loaded, Messages& messages) {
                       Stage(loaded, {loaded.job.frames.front()}).make_integrator(messages);
                       keep_guide(options, loaded.job);
                       messages.say("scene ok: {}", summary_of(loaded));
                       return 0;
                     });
}

}  // namespace dspm
