#include "dspm/checkpoint/checkpoints.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/math/frames.h"
#include "dspm/session/distinct_files.h"
#include "dspm/session/revertible.h"
#include "dspm/system/atomic_file.h"
#include "dspm/system/readable.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

constexpr Interval kEvery{.seconds = 600};

/// Of all intervals' states, each in proportion to its frames.
std::uint64_t bytes_of_all(const std::vector<FrameList>& intervals, std::uint64_t first) {
  std::size_t frames = 0;
  for (const FrameList& interval : intervals) frames += interval.size();
  return first * frames / intervals.front().size();
}

std::string in_words(const Interval& every) {
  return every.seconds > 0 ? readable_time(every.seconds)
                           : counted(static_cast<std::size_t>(every.iterations), "iteration");
}

/// A forged file could name frames that do not exist.
void expect_frames(const std::vector<IntervalState>& intervals, const Job& job, const std::string& file) {
  FrameList all;
  bool valid = true;
  for (const IntervalState& interval : intervals) {
    const FrameList& frames = interval.frames;
    valid = valid && !frames.empty() && frames.size() <= kMaxFrames && std::is_sorted(frames.begin(), frames.end());
    all.insert(all.end(), frames.begin(), frames.end());
  }
  std::sort(all.begin(), all.end());
  if (!valid || all != job.frames)
    throw std::runtime_error(fmt::format("checkpoint {}: its frames are not those to render", file));
}

void refuse_to_overwrite(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return;
  throw UsageError(fmt::format("--checkpoint {}: it exists already; continue it with --resume {}, or remove it first",
                               path.string(), path.string()));
}

/// For a file that is not this run's.
void leave_to_others(const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) throw WriteError(path, "another program has put a file of its own there");
}

}  // namespace

Checkpoints::Checkpoints(const Job& job, const CheckpointSettings& settings, Messages& messages)
    : messages_(messages),
      path_(settings.checkpoint.empty() ? settings.resume : settings.checkpoint),
      every_(settings.checkpoint_every.value_or(kEvery)),
      schedule_(every_) {
  if (!writes()) return;
  if (settings.resume.empty() || !is_same_file(path_, settings.resume)) refuse_to_overwrite(path_);
  facts_ = facts_of(job);
  if (settings.resume.empty()) return;
  last_ = std::make_unique<CheckpointFile>(settings.resume);
  Diagnostics diagnostics;
  compare(last_->facts(), facts_, diagnostics);
  diagnostics.throw_if_errors();
  expect_frames(last_->intervals(), job, settings.resume);
}

std::vector<IntervalState> Checkpoints::states() const {
  return last_ == nullptr ? std::vector<IntervalState>() : last_->intervals();
}

std::vector<FrameList> Checkpoints::intervals() const {
  std::vector<FrameList> intervals;
  for (const IntervalState& state : states()) intervals.push_back(state.frames);
  return intervals;
}

double Checkpoints::seconds() const {
  double sum = 0;
  for (const IntervalState& state : states()) sum += state.seconds;
  return sum;
}

void Checkpoints::begin(const std::vector<FrameList>& intervals, Integrator& first) {
  if (!writes()) return;
  const std::optional<std::uint64_t> bytes = state_bytes(first);
  if (!bytes) throw UsageError("--checkpoint: this integrator does not support checkpoints (Integrator::persist)");
  const std::uint64_t all = bytes_of_all(intervals, *bytes);
  std::vector<IntervalState> states = this->states();
  if (states.empty())
    for (const FrameList& interval : intervals) states.push_back({interval});
  // Takes the name at once, and keeps the resumed state even if nothing is left to do.
  if (last_ == nullptr || !last_->is_at(path_)) {
    leave_to_others(path_);
    last_ = CheckpointFile::write(path_, facts_, std::move(states), nullptr, last_.get());
  }
  AtomicFile(path_).reserve(all + fs::file_size(path_));
  messages_.say("checkpoint: {}, {}, every {}", path_.string(), readable_bytes(all), in_words(every_));
}

IntervalProgress Checkpoints::resume(std::size_t interval, Integrator& integrator) const {
  if (!writes()) return {.index = interval};
  const std::vector<IntervalState>& states = last_->intervals();
  const IntervalState& state = states[interval];
  if (state.iterations == 0) return {.index = interval};
  last_->load(interval, integrator);
  messages_.say("resumed after iteration {}{}", state.iterations,
                states.size() > 1 ? fmt::format(" of frame interval {}/{}", interval + 1, states.size()) : "");
  return {.index = interval, .iterations = state.iterations, .seconds = state.seconds};
}

void Checkpoints::save(const IntervalProgress& progress, Integrator& integrator) {
  if (!writes()) return;
  std::vector<IntervalState> states = last_->intervals();
  states[progress.index].iterations = progress.iterations, states[progress.index].seconds = progress.seconds;
  if (!last_->is_at(path_)) leave_to_others(path_);
  const CheckpointFile::NewState state{progress.index, integrator};
  last_ = CheckpointFile::write(path_, facts_, std::move(states), &state, last_.get());
}

}  // namespace dspm
