#include "dspm/session/session.h"

#include <algorithm>
#include <limits>
#include <new>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/readable.h"
#include "dspm/session/block.h"
#include "dspm/session/can_part.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/session/out_of_memory.h"
#include "dspm/session/revertible.h"

namespace dspm {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity(), kEndless = kUnknown;

std::optional<double> worst_error(const Integrator& integrator) {
  const std::vector<double> errors = integrator.statistics().errors;
  if (errors.empty()) return std::nullopt;
  return *std::max_element(errors.begin(), errors.end());
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Session::Session(const LoadedScene& loaded, const std::vector<FrameList>& intervals, const MemoryBound& memory,
                 const SessionSettings& settings, Messages& messages, SessionObserver& observer)
    : loaded_(loaded),
      intervals_(intervals),
      memory_(memory),
      settings_(settings),
      messages_(messages),
      observer_(observer),
      integrator_(in_words("integrator", loaded.job.integrator)),
      warnings_(loaded.job, messages) {}

void Session::run() {
  for (std::size_t i = 0; i < intervals_.size() && !observer_.end_wanted(); ++i) render_interval(i);
}

double Session::time_share(std::size_t index) const {
  if (settings_.time_limit == 0) return kEndless;
  return (settings_.time_limit - seconds_since(begin_)) / static_cast<double>(intervals_.size() - index);
}

int Session::iterations_of(const Integrator& integrator) const {
  const int all = loaded_.job.iterations(integrator);
  if (all == 0) return 0;
  expect_enough_iterations(all, settings_.part, fmt::format("--part {}/{}", settings_.part.number, settings_.part.of));
  return settings_.part.share_of(all);
}

void Session::render_interval(std::size_t index) {
  const Share time{Clock::now(), time_share(index)};
  observer_.step_begins("making the scene", "");
  const Places places = index < settings_.places.size() ? settings_.places[index] : Places{intervals_[index], {}};
  Stage stage(loaded_, places.frames);
  equip(stage, index, places.given_up);
  Integrator& integrator = stage.integrator();
  const int iterations = iterations_of(integrator);
  if (iterations == 0 && settings_.time_limit == 0 && loaded_.job.until_error == 0 && intervals_.size() > 1)
    throw UsageError(
        fmt::format("the first of {} frame intervals would never end: give --time-limit, --iterations or --until-error",
                    intervals_.size()));
  if (index == 0) observer_.ready(stage.scene(), integrator, iterations);
  const IntervalProgress progress = iterate_to_the_end(index, stage, iterations, time);
  observer_.interval_ends(progress, stage.scene(), integrator);
}

void Session::equip(Stage& stage, std::size_t index, FrameSet given_up) {
  StageSettings settings{.memory = memory_.for_integrator(index), .given_up = given_up};
  if (settings_.share_out)
    settings.share_out = [&](std::unique_ptr<Integrator> sum, std::unique_ptr<Integrator> own) {
      const int all = iterations_of(*sum);
      return settings_.share_out(index, stage, std::move(sum), std::move(own), all);
    };
  stage.make_integrator(messages_, settings);
}

IntervalProgress Session::iterate_to_the_end(std::size_t index, Stage& stage, int iterations, const Share& time) {
  Integrator& integrator = stage.integrator();
  IntervalProgress progress = observer_.interval_begins(index, integrator);
  progress.error = worst_error(integrator);
  const double seconds_before = progress.seconds;
  const int first = progress.iterations;
  const Clock::time_point begin = Clock::now();
  WriteSchedule schedule(settings_.write_every);
  schedule.begin(first);
  if (iterations > 0 && progress.iterations >= iterations)
    messages_.say("{} done, none is left; ask for more with --iterations",
                  counted(static_cast<std::size_t>(progress.iterations), "iteration"));
  const double wanted_error = loaded_.job.until_error;
  const auto is_good = [&] { return wanted_error > 0 && progress.error && *progress.error <= wanted_error; };
  if (is_good()) messages_.say("the error is as small as wanted already; ask for less with --until-error");
  int more_until = 0;  // iterations beyond what was asked for at first
  const auto finished = [&] {
    if (observer_.end_wanted()) return true;
    if (more_until > 0) return progress.iterations >= more_until;
    return (iterations > 0 && progress.iterations >= iterations) || is_good() ||
           (progress.iterations > 0 && seconds_since(time.begin) >= time.limit);
  };
  const auto expected = [&] {
    const int done = progress.iterations - first;
    return done > 0 ? seconds_since(begin) / done : kUnknown;
  };
  const auto goes_on = [&] {
    if (finished() && !observer_.end_wanted())
      if (const int more = observer_.more_iterations(progress, integrator)) more_until = progress.iterations + more;
    return !finished();
  };
  while (goes_on() && iterate(progress, stage, expected())) {
    const int before = progress.iterations;
    progress.iterations = Block::from(before, iterations, settings_.block).end;
    progress.seconds = seconds_before + seconds_since(time.begin);
    progress.error = worst_error(integrator);
    observer_.iteration_done(progress, integrator);
    if (before < RunWarnings::kFirstLook && progress.iterations >= RunWarnings::kFirstLook)
      warnings_.look(integrator.statistics(), iterations);
    const bool wanted = observer_.images_wanted();
    if (wanted)
      messages_.say("writing the images after {}, as requested",
                    counted(static_cast<std::size_t>(progress.iterations), "iteration"));
    if ((schedule.due(progress.iterations) || wanted) && !finished())
      write(progress, integrator, SessionObserver::Images::so_far);
  }
  progress.seconds = seconds_before + seconds_since(time.begin);
  if (progress.iterations > 0) write(progress, integrator, SessionObserver::Images::last);
  judge(progress, integrator);
  return progress;
}

void Session::judge(const IntervalProgress& progress, const Integrator& integrator) {
  const Statistics statistics = integrator.statistics();
  warnings_.look(statistics, progress.iterations);
  if (loaded_.job.until_error == 0) return;
  warnings_.look_at_errors(statistics, intervals_[progress.index]);
  const std::string iterations = counted(static_cast<std::size_t>(progress.iterations), "iteration");
  if (!progress.error) return messages_.say("{} are too few to estimate the error", iterations);
  const double radius = statistics.typical.radius_in_pixels;
  messages_.say("{}: the estimated error is {}{}{}", iterations, readable_share(*progress.error),
                *progress.error > loaded_.job.until_error ? ", more than was wanted" : "",
                radius > 0 ? fmt::format("; not in it is the blur of photons, within {:.1f} pixels", radius) : "");
}

// Photons in batches have room for the copy in the plan of --memory. Without a bound a large one must not be most of
// the memory.
bool Session::can_copy(Integrator& integrator, std::size_t index) const {
  constexpr std::uint64_t kSmall = 1 << 20;
  const std::optional<std::uint64_t> copy = state_bytes(integrator);
  const Statistics statistics = integrator.statistics();
  const std::size_t share = memory_.for_integrator(index);
  if (!copy || statistics.photon_batches > 1) return copy.has_value();
  return share > 0 ? statistics.bytes + *copy <= share : *copy <= kSmall || 2 * *copy <= statistics.bytes;
}

void Session::iterate_cancellably(const IntervalProgress& before, Stage& stage, double expected) const {
  Integrator& integrator = stage.integrator();
  const Iteration iteration = stage.iteration(settings_.part.iteration(before.iterations));
  if (before.iterations == 0) {  // nothing can be lost
    const Cancellable cancellable;
    return integrator.iterate(iteration);
  }
  if (expected >= settings_.long_iteration && can_copy(integrator, before.index))
    return iterate_revertibly(integrator, iteration);
  const Cancellable cancellable(Cancellable::Loss::results);
  integrator.iterate(iteration);
}

bool Session::iterate(const IntervalProgress& before, Stage& stage, double expected) {
  constexpr std::size_t kLibraries = 1 << 20;  // for OpenEXR and zlib
  const std::string step = fmt::format("iteration {}", before.iterations + 1);
  observer_.step_begins(step, integrator_);
  try {
    // Address space only. It is free again in the catch clause, so that images can be written even if memory runs out.
    const std::unique_ptr<char[]> reserve(new (std::nothrow) char[settings_.bytes_for_writing + kLibraries]);
    asm volatile("" : : "g"(reserve.get()) : "memory");  // else compilers may drop the unused allocation
    naming_memory_step([&] { return step; }, [&] { iterate_cancellably(before, stage, expected); });
    return true;
  } catch (const Cancelled&) {
    return false;
  } catch (...) {
    if (before.iterations > 0) write(before, stage.integrator(), SessionObserver::Images::after_failure);
    observer_.iteration_failed();
    throw;
  }
}

void Session::write(const IntervalProgress& progress, Integrator& integrator, SessionObserver::Images images) {
  observer_.step_begins("writing the images", "");
  observer_.images_due(progress, integrator, images);
}

}  // namespace dspm
