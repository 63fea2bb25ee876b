#include <fmt/format.h>

#include <algorithm>

#include "dspm/app/options/options.h"
#include "dspm/app/run/render.h"
#include "dspm/app/run/run.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/readable.h"
#include "dspm/output/results.h"
#include "dspm/session/checkpoint/guide_file.h"
#include "dspm/session/checkpoint/merged_parts.h"
#include "dspm/session/load.h"
#include "dspm/session/stage.h"

namespace dspm {
namespace {

Options options_of(const Options& given, const MergedParts& parts) {
  Options options = given.scenes.empty() ? with_scene_of_parts(given, parts.render().words) : given;
  options.known = parts.render().frames;
  return options;
}

class Merge {
 public:
  Merge(const LoadedScene& loaded, const Options& options, const MergedParts& parts, Messages& messages)
      : loaded_(loaded),
        parts_(parts),
        messages_(messages),
        results_(loaded.job, *loaded.world, options, other_files(options), true, messages,
                 [] { return InterruptRequests::signal() != 0; }),
        checkpoints_(loaded.job, loaded.world->sampling(), checkpoint_of(options), nullptr, messages) {
    report_.threads = thread_count();
  }

  int run() {
    for (std::size_t i = 0; i < parts_.intervals().size(); ++i) merge(parts_.progress(i));
    results_.say_end(report_.seconds, InterruptRequests::signal() != 0);
    report_.exit_code = InterruptRequests::exit_code(results_.are_whole() ? 0 : 1);
    return InterruptRequests::exit_code(results_.finish(report_) ? 0 : 1);
  }

 private:
  static CheckpointSettings checkpoint_of(const Options& options) {
    CheckpointSettings settings;
    settings.checkpoint = options.checkpoint;
    return settings;
  }

  void merge(const IntervalProgress& progress) {
    if (progress.iterations == 0 || InterruptRequests::signal() != 0) return;
    const FrameList& frames = parts_.intervals()[progress.index];
    Stage stage(loaded_, frames);
    Integrator& integrator = stage.make_integrator(messages_);
    parts_.load(progress.index, integrator);
    if (!std::exchange(has_begun_, true)) checkpoints_.begin(parts_.intervals(), integrator);
    checkpoints_.save(progress, integrator);
    results_.write(frames, integrator, progress.seconds, Results::Images::last);
    report_.seconds += progress.seconds;
    report_.tree_bytes = std::max(report_.tree_bytes, stage.scene().accel->memory());
    report_.add(integrator.statistics(), frames);
  }

  const LoadedScene& loaded_;
  const MergedParts& parts_;
  Messages& messages_;
  Results results_;
  Checkpoints checkpoints_;
  bool has_begun_ = false;
  RunReport report_;
};

}  // namespace

int merge_parts(const Options& given) {
  const ThreadLimit threads(given.threads);
  Messages messages(given.quiet);
  MergedParts parts(given.parts);
  const Options options = options_of(given, parts);
  LoadedScene loaded(options.scenes, options, messages);
  take_part_of_frames(options.frame_part, loaded.job);
  if (!options.guide.empty()) load_guide(options.guide, loaded.job);
  parts.expect_same(loaded.job);
  parts.describe(messages);
  if (!options.checkpoint.empty() && !parts.are_whole())
    throw UsageError(
        fmt::format("--checkpoint {}: no render can go on from there, as iterations are missing before the last one",
                    options.checkpoint));
  const InterruptRequests interrupts;
  return Merge(loaded, options, parts, messages).run();
}

}  // namespace dspm
