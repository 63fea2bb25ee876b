#include "dspm/app/together.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>

#include "dspm/app/render.h"
#include "dspm/app/signals.h"
#include "dspm/machines/helper.h"
#include "dspm/system/cancellation.h"
#include "dspm/system/parallel.h"

namespace dspm {
namespace {

void refuse_what_needs_one_machine(const Options& o) {
  const auto refuse = [](bool is_given, const char* option, const char* why) {
    if (is_given) throw UsageError(fmt::format("{} does not go together with mpirun: {}", option, why));
  };
  refuse(o.until_error > 0, "--until-error", "no machine knows the error of the whole while it works");
  refuse(!o.part.is_all() || !o.frame_part.is_all(), "--part", "the machines share out all iterations already");
  refuse(o.serve.has_value(), "--serve", "edits would have to reach all machines; --display-server shows images");
  for (const std::string& scene : o.scenes)
    refuse(scene == "-", "-", "every machine reads the scene, so it cannot come from standard input");
}

std::string host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

int help(const Options& options, Link& link) {
  SignalHandlers handlers;  // the leader decides what a signal means
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) handlers.handle(signal, SIG_IGN);
  Helper helper(link, [] { cancel_work(); });
  try {
    const Cancellable nothing_is_lost;
    const ThreadLimit threads(options.threads);
    Messages messages(true);
    const std::unique_ptr<const CheckpointFile> resumed = file_to_resume(options);
    LoadedScene loaded(options.scenes, choices_of(options, resumed.get()), messages);
    prepare(options, resumed.get(), true, loaded.job);
    helper.render(loaded, messages, host(), digest_of(loaded.job));
  } catch (const Cancelled&) {  // it is over
  } catch (const std::exception& error) {
    helper.fail(fmt::format("{}: {}", host(), error.what()));
  }
  return 0;
}

}  // namespace

int render_together(const Options& options, Link& link) {
  refuse_what_needs_one_machine(options);
  return link.me() == 0 ? render_scene(options, &link) : help(options, link);
}

}  // namespace dspm
