#include "dspm/session/memory_bound.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/memory_use.h"
#include "dspm/base/system/readable.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/session/revertible.h"
#include "dspm/session/stage.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr std::size_t kProgram = 17 << 20;          // code, libraries, a stack: all before the scene is read
constexpr std::size_t kThreads = 64 * (128 << 10);  // stacks and working memory of 64 threads
// Plan and run differ slightly in what they hold: an interval that fits in the plan must also fit in the run.
constexpr std::size_t kLeeway = 1 << 20;
constexpr int kReturnedFrom = 1 << 17;  // bytes; larger blocks go back to the system as soon as they are freed

std::size_t allocated() {
  malloc_trim(0);
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

int longest(const std::vector<FrameList>& intervals) {
  std::size_t length = 0;
  for (const FrameList& interval : intervals) length = std::max(length, interval.size());
  return static_cast<int>(length);
}

/// Returns the lengths that the longest interval can have, in descending order.
std::vector<int> interval_lengths(const FrameIntervals& frames, int together) {
  std::vector<int> lengths;
  for (int most = together; most > 0; --most)
    if (const int length = longest(frames.cut(most)); lengths.empty() || length < lengths.back())
      lengths.push_back(length);
  return lengths;
}

std::string in_words(std::size_t intervals, int length, int batches) {
  const std::string frames = counted(static_cast<std::size_t>(length), "frame");
  return (intervals == 1 ? frames + " together" : fmt::format("{} intervals of {}", intervals, frames)) +
         (batches == 1 ? "" : fmt::format(", photons in {} batches", batches));
}

/// Returns the frames that are in none of the intervals.
FrameList without(const FrameList& frames, const std::vector<FrameList>& intervals) {
  std::set<FileFrame> taken;
  for (const FrameList& interval : intervals) taken.insert(interval.begin(), interval.end());
  FrameList rest;
  for (const FileFrame frame : frames)
    if (!taken.contains(frame)) rest.push_back(frame);
  return rest;
}

/// A trial's warnings: the run shows them.
class ShownLater final : public Messages {
 public:
  ShownLater() : Messages(true) {}

 protected:
  void print(std::string_view) const override {}
};

}  // namespace

/// Makes what a run would make for an interval, and remembers why it did not fit.
class MemoryBound::Trials {
 public:
  /// The result for an interval that fits.
  struct Result {
    std::size_t share;  // bytes that its integrator may hold
    int batches;        // of photons in an iteration
  };

  Trials(const MemoryBound& bound, const Job& job, const World& world, const Besides& besides,
         const SessionObserver& observer)
      : bound_(bound), job_(job), world_(world), besides_(besides), observer_(observer) {}

  std::optional<Result> of(const FrameList& frames) {
    if (observer_.end_wanted()) throw std::runtime_error("interrupted before the first iteration");
    // Those of an iteration, beside the stage's own.
    const std::size_t scenes = job_.shutter.delays() ? 1 + static_cast<std::size_t>(job_.moments) : 1;
    const std::size_t before = bound_.held(), trees = scenes * world_.tree_bytes_at_most(frames);
    if (before + trees > bound_.bytes_) {
      shortage_ = fmt::format("{}: scene and program {}, trees up to {}, and more", readable_bytes(before + trees),
                              readable_bytes(before), readable_bytes(trees));
      return {};
    }
    Stage stage(job_, world_, frames);
    // What was learned for an earlier trial counts among the integrator's own.
    const std::size_t held = bound_.held() - job_.settings.file->bytes() + kLeeway;
    std::size_t of_machines = 0, taken = held + besides_.writing;
    const auto share = [&] { return taken < bound_.bytes_ ? bound_.bytes_ - taken : 1; };
    ShownLater messages;
    const auto make = [&]() -> Integrator& { return stage.make_integrator(messages, {.memory = share()}); };
    try {
      Integrator& integrator = make();
      if (besides_.states > 0) {
        of_machines = integrator.statistics().bytes + besides_.states * state_bytes(integrator).value_or(0);
        taken += of_machines;
        make();
      }
      return Result{share(), stage.integrator().statistics().photon_batches};
    } catch (const NotEnoughMemory& error) {
      const std::size_t tree = stage.scene().accel->memory();
      const MemoryNeeds& needs = error.least;
      shortage_ =
          needs.learning == needs.total()
              ? fmt::format(
                    "{}: scene and program {}, learning where photons start and what rays find {} (\"string "
                    "emission\" \"power\" with \"string direct\" \"photons\" takes none)",
                    readable_bytes(taken + needs.learning), readable_bytes(held), readable_bytes(needs.learning))
              : fmt::format(
                    "{}: scene and program {}, trees {}, pixels {}, hit points {}, photons {}, writing of images {}",
                    readable_bytes(taken + needs.total()), readable_bytes(held - tree), readable_bytes(tree),
                    readable_bytes(needs.pixels), readable_bytes(needs.hit_points), readable_bytes(needs.photons),
                    readable_bytes(besides_.writing));
      if (of_machines > 0) shortage_ += fmt::format(", sums of machines {}", readable_bytes(of_machines));
      return {};
    }
  }

  /// Returns one result each; none if one interval does not fit.
  std::vector<Result> of(const std::vector<FrameList>& intervals) {
    std::vector<Result> results;
    for (const FrameList& interval : intervals) {
      const std::optional<Result> result = of(interval);
      if (!result) return {};
      results.push_back(*result);
    }
    return results;
  }

  const FrameList& with_largest_trees(const std::vector<FrameList>& intervals) const {
    return *std::max_element(intervals.begin(), intervals.end(), [&](const auto& a, const auto& b) {
      return world_.tree_bytes_at_most(a) < world_.tree_bytes_at_most(b);
    });
  }

  const std::string& shortage() const { return shortage_; }

 private:
  const MemoryBound& bound_;
  const Job& job_;
  const World& world_;
  const Besides& besides_;
  const SessionObserver& observer_;
  std::string shortage_;
};

MemoryBound::MemoryBound(std::size_t bytes) : bytes_(bytes) {
  if (bytes == 0) return;
  mallopt(M_MMAP_THRESHOLD, kReturnedFrom);  // else the threshold grows with what is freed
  one_thread_.emplace(1);
  held_before_ = allocated();
}

std::size_t MemoryBound::held() const { return kProgram + kThreads + allocated() - held_before_; }

std::vector<FrameList> MemoryBound::plan(const Job& job, const World& world, const Besides& besides,
                                         const std::vector<FrameList>& given, const Messages& messages,
                                         const SessionObserver& observer) {
  const FrameList rest = without(job.frames, given);
  const FrameIntervals frames(*job.description, rest);
  const auto cut = [&](int together) {
    std::vector<FrameList> intervals = given;
    if (!rest.empty())
      for (FrameList& each : frames.cut(together)) intervals.push_back(std::move(each));
    return intervals;
  };
  if (bytes_ == 0) return cut(job.plugin->frames_together);
  const std::string bound = "memory " + readable_bytes(bytes_);
  if (const std::size_t peak = peak_memory(); peak > bytes_)
    throw std::runtime_error(fmt::format("{}: reading the scene alone took {}; rendering needs a larger bound", bound,
                                         readable_bytes(peak)));

  Trials trials(*this, job, world, besides, observer);
  const auto accepts = [&](const std::vector<FrameList>& intervals) {
    const std::vector<Trials::Result> results = trials.of(intervals);
    int batches = 1;
    shares_.clear();
    for (const Trials::Result& result : results) {
      batches = std::max(batches, result.batches);
      shares_.push_back(result.share);
    }
    if (results.empty()) return false;
    messages.say("{}: {}", bound, in_words(intervals.size(), longest(intervals), batches));
    one_thread_.reset();
    return true;
  };
  if (rest.empty()) {
    if (accepts(given)) return given;
    throw std::runtime_error(fmt::format("{}: the checkpoint's {} together take {}", bound,
                                         counted(static_cast<std::size_t>(longest(given)), "frame"),
                                         trials.shortage()));
  }
  const std::vector<int> lengths = interval_lengths(frames, job.plugin->frames_together);
  auto length = std::partition_point(lengths.begin(), lengths.end(), [&](int candidate) {
    return !trials.of(trials.with_largest_trees(frames.cut(candidate)));
  });
  for (; length != lengths.end(); ++length)
    if (std::vector<FrameList> intervals = cut(*length); accepts(intervals)) return intervals;
  throw std::runtime_error(fmt::format("{}: even one frame at a time takes {}", bound, trials.shortage()));
}

}  // namespace dspm
