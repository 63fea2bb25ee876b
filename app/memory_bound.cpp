#include "app/memory_bound.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/run_report.h"
#include "integrators/memory_needs.h"

namespace dspm {
namespace {

constexpr std::size_t kProgram = 12 << 20;  // code, libraries, stacks: what malloc knows nothing of
// What is held differs by little between the plan and the run: an interval that fits into the plan must fit then.
constexpr std::size_t kLeeway = 1 << 20;
constexpr int kReturnedFrom = 1 << 17;  // bytes of a block that goes back to the system as soon as it is freed

std::size_t held() {
  malloc_trim(0);
  const struct mallinfo2 info = mallinfo2();
  return kProgram + info.uordblks + info.hblkhd;
}

int longest(const std::vector<FrameList>& intervals) {
  std::size_t length = 0;
  for (const FrameList& interval : intervals) length = std::max(length, interval.size());
  return static_cast<int>(length);
}

/// All lengths that intervals may have at most, the longest first.
std::vector<int> interval_lengths(const FrameIntervals& frames, int together) {
  std::vector<int> lengths;
  for (int most = together; most > 0; --most)
    if (const int length = longest(frames.cut(most)); lengths.empty() || length < lengths.back())
      lengths.push_back(length);
  return lengths;
}

std::string in_words(std::size_t intervals, int length, int batches) {
  const std::string frames = length == 1 ? "1 frame" : fmt::format("{} frames", length);
  return (intervals == 1 ? frames + " together" : fmt::format("{} intervals of {}", intervals, frames)) +
         (batches == 1 ? "" : fmt::format(", photons in {} batches", batches));
}

}  // namespace

/// Makes for an interval what a run would make, and remembers what was too much.
class MemoryBound::Trials {
 public:
  Trials(const MemoryBound& bound, const Job& job, const World& world) : bound_(bound), job_(job), world_(world) {}

  /// In how many batches the photons of an iteration come; 0: the interval does not fit.
  int batches(const FrameList& frames) {
    const std::size_t before = held(), trees = world_.tree_bytes_at_most(frames);
    if (before + trees > bound_.bytes_) {
      shortage_ = fmt::format("{}: scene and program {}, trees up to {}, and more", readable_bytes(before + trees),
                              readable_bytes(before), readable_bytes(trees));
      return 0;
    }
    const std::unique_ptr<Scene> scene = world_.scene(frames);
    try {
      Diagnostics shown_later;
      const std::size_t left = bound_.for_integrator();
      return job_.make_integrator(*scene, shown_later, left - std::min(left - 1, kLeeway))->statistics().photon_batches;
    } catch (const NotEnoughMemory& error) {
      const std::size_t now = held() + kLeeway, tree = scene->accel->memory();
      const MemoryNeeds& needs = error.least;
      shortage_ =
          fmt::format("{}: scene and program {}, trees {}, pixels {}, hit points {}, photons {}, writing of images {}",
                      readable_bytes(now + bound_.writing_ + needs.total()), readable_bytes(now - tree),
                      readable_bytes(tree), readable_bytes(needs.pixels), readable_bytes(needs.hit_points),
                      readable_bytes(needs.photons), readable_bytes(bound_.writing_));
      return 0;
    }
  }

  /// Of the interval that takes most; 0: one does not fit.
  int batches(const std::vector<FrameList>& intervals) {
    int most = 1;
    for (const FrameList& interval : intervals) {
      const int of_interval = batches(interval);
      if (of_interval == 0) return 0;
      most = std::max(most, of_interval);
    }
    return most;
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
  std::string shortage_;
};

MemoryBound::MemoryBound(std::size_t bytes) : bytes_(bytes) {
  if (bytes > 0) mallopt(M_MMAP_THRESHOLD, kReturnedFrom);  // else the threshold grows with what is freed
}

std::size_t MemoryBound::for_integrator() const {
  if (bytes_ == 0) return 0;
  const std::size_t taken = held() + writing_;
  return taken < bytes_ ? bytes_ - taken : 1;
}

std::vector<FrameList> MemoryBound::plan(const Job& job, const World& world, std::size_t writing,
                                         const Messages& messages) {
  writing_ = writing;
  const FrameIntervals frames(*job.description, job.frames);
  if (bytes_ == 0) return frames.cut(job.plugin->frames_together);
  const std::string bound = "memory " + readable_bytes(bytes_);
  if (const std::size_t peak = peak_memory(); peak > bytes_)
    throw std::runtime_error(fmt::format("{}: reading the scene took {}", bound, readable_bytes(peak)));

  Trials trials(*this, job, world);
  const std::vector<int> lengths = interval_lengths(frames, job.plugin->frames_together);
  auto length = std::partition_point(lengths.begin(), lengths.end(), [&](int candidate) {
    return trials.batches(trials.with_largest_trees(frames.cut(candidate))) == 0;
  });
  for (; length != lengths.end(); ++length) {
    const std::vector<FrameList> intervals = frames.cut(*length);
    if (const int batches = trials.batches(intervals); batches > 0) {
      messages.say("{}: {}", bound, in_words(intervals.size(), *length, batches));
      return intervals;
    }
  }
  throw std::runtime_error(fmt::format("{}: even one frame at a time takes {}", bound, trials.shortage()));
}

}  // namespace dspm
