#include "dspm/app/run/render_live.h"

#include <exception>
#include <memory>
#include <optional>

#include "dspm/app/run/coarse.h"
#include "dspm/app/run/render.h"
#include "dspm/base/system/file_access.h"
#include "dspm/base/system/files_read.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/looking/serve/edits.h"
#include "dspm/session/learned_before.h"
#include "dspm/session/out_of_memory.h"
#include "dspm/world/objects/kept_geometry.h"

namespace dspm {
namespace {

bool is_interrupted() { return InterruptRequests::signal() != 0; }

/// Renders until the scene has changed, or the run is over. `is_edited` is false the first time. `learned` holds what
/// the last run learned, and then what this one does.
int render_once(Options options, const Surroundings& around, Edits& edits, bool is_edited, LearnedBefore& learned) {
  const auto step_begins = [&] {
    const char* const step = "reading the scene";
    around.watch.begin(step, ""), around.last_words.begin(step, ""), around.live->step_begins(step);
  };
  around.live->begin();  // before the scene is taken, so that no later one is missed
  options.look_at = around.live->camera();
  if (is_edited && around.leader != nullptr) around.leader->begin_anew(options.look_at);
  forget_files_read();
  step_begins();
  std::unique_ptr<LoadedScene> coarse = edits.take();
  if (coarse == nullptr) coarse = load_coarsely(options, around.messages, *around.kept);
  learned.give(coarse->job);
  show_coarsely(*coarse, *around.live);
  coarse.reset();
  if (around.live->is_restarting()) return 0;
  step_begins();
  return load_and(
      options, around, [] {},
      [&](Render& render, const LoadedScene& loaded) {
        const int code = render.run();
        learned.keep(loaded.job);
        return code;
      });
}

}  // namespace

int render_live(Options options, Link* others) {
  refuse_pipes();
  const ImageRequests image_requests;
  const ThreadLimit threads(options.threads);
  const LivePage* page = nullptr;
  // First, as the others wait for a leader, whatever becomes of the page.
  std::optional<Leader> leader;
  if (others != nullptr)
    leader.emplace(
        *others, [&] { return is_interrupted() || (page != nullptr && page->end_wanted()); },
        options.longest_silence());
  LivePage live(*options.serve, options.view);
  page = &live;
  LiveMessages messages(options.quiet, live);
  messages.say("the page is at {}", live.url());
  if (options.view.view.starts_with("ocio")) messages.say("the page knows no OpenColorIO: it shows agx");
  MemoryBound memory(0);
  Watch watch(options.patience);
  LastWords last_words;
  const InterruptRequests interrupts;
  KeptGeometry kept;
  LearnedBefore learned;
  const Surroundings around{messages, memory, watch, last_words, &live, leader ? &*leader : nullptr, &kept};
  Edits edits(live, options.scenes, [&] {
    LiveMessages of_edit(options.quiet, live);
    Options edited = options;
    edited.look_at = live.camera();
    return load_coarsely(edited, of_edit, kept);
  });
  /// Returns false if the end is wanted.
  const auto waits_for_edit = [&](const std::exception& error) {
    live.show_problem(error.what());
    print_message(error.what());
    watch.begin("", "");
    return live.wait_for_restart(is_interrupted);
  };
  for (bool is_edited = false;; is_edited = true) try {
      const int code = naming_memory_step([&] { return watch.step(); },
                                          [&] { return render_once(options, around, edits, is_edited, learned); });
      if (!live.is_restarting()) return code;
      options.resume.clear();  // that was another scene
    } catch (const SceneError& error) {
      if (!waits_for_edit(error)) throw;
    } catch (const MachineFailed& error) {
      if (!waits_for_edit(error)) throw;
    }
}

}  // namespace dspm
