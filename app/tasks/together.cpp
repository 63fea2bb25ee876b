#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>

#include "dspm/app/options/options.h"
#include "dspm/app/run/render.h"
#include "dspm/app/run/signals.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/parallel.h"
#include "dspm/session/machines/helper.h"
#include "dspm/session/machines/link.h"
#include "dspm/world/objects/kept_geometry.h"

namespace dspm {
namespace {

void refuse_what_needs_one_machine(const Options& o) {
  const auto refuse = [](bool is_given, const char* option, const char* why) {
    if (is_given) throw UsageError(fmt::format("{} does not go together with mpirun: {}", option, why));
  };
  refuse(!o.part.is_all() || !o.frame_part.is_all(), "--part", "the machines share out all iterations already");
  for (const std::string& scene : o.scenes)
    refuse(scene == "-", "-", "every machine reads the scene, so it cannot come from standard input");
}

std::string host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::optional<Edition> next_edition(Helper& helper) {
  allow_work();  // before the question: work is cancelled after each later edition
  return helper.edition();
}

int help(Options options, Link& link) {
  SignalHandlers handlers;  // the leader decides what a signal means
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) handlers.handle(signal, SIG_IGN);
  const ThreadLimit threads(options.threads);
  KeptGeometry kept;
  Helper helper(link, [] { cancel_work(); });
  while (const std::optional<Edition> edition = next_edition(helper)) try {
      if (edition->number > 0) options.resume.clear(), options.look_at = edition->look_at;  // that was another scene
      const Cancellable nothing_is_lost;
      Messages messages(true);
      const std::unique_ptr<const CheckpointFile> resumed = file_to_resume(options);
      LoadedScene loaded(options.scenes, choices_of(options, resumed.get()), messages, std::nullopt,
                         options.serve ? &kept : nullptr);
      prepare(options, resumed.get(), true, loaded.job);
      helper.render(loaded, messages, {host(), digest_of(loaded.job), edition->number});
    } catch (const Cancelled&) {  // it is over, or there is another edition
    } catch (const std::exception& error) {
      helper.fail({edition->number, fmt::format("{}: {}", host(), error.what())});
    }
  return 0;
}

}  // namespace

int render_together(const Options& options, Link& link) {
  refuse_what_needs_one_machine(options);
  return link.me() == 0 ? render_scene(options, &link) : help(options, link);
}

}  // namespace dspm
