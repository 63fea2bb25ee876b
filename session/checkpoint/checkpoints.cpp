#include "dspm/session/checkpoint/checkpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/machine.h"
#include "dspm/base/system/readable.h"
#include "dspm/integrators/possible_state.h"
#include "dspm/session/checkpoint/changes.h"
#include "dspm/session/distinct_files.h"
#include "dspm/session/revertible.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

constexpr Interval kEvery{.seconds = 600};

/// Estimates the bytes of all intervals' states, each in proportion to its frames.
std::uint64_t bytes_of_all(const std::vector<FrameList>& intervals, std::uint64_t first) {
  std::size_t frames = 0;
  for (const FrameList& interval : intervals) frames += interval.size();
  return first * frames / intervals.front().size();
}

std::string in_words(const Interval& every) {
  return every.seconds > 0 ? readable_time(every.seconds)
                           : counted(static_cast<std::size_t>(every.iterations), "iteration");
}

KnownFrames frames_to_keep(const Job& job) {
  const FileFrames& frames = job.description->frames;
  KnownFrames known{frames.base(), frames.moments(), {}, {}};
  for (const Combination& each : frames.combinations()) known.names.push_back(each.name);
  return known;
}

bool is_among(const FrameList& frames, const FrameList& all) {
  return std::includes(all.begin(), all.end(), frames.begin(), frames.end());
}

void refuse_to_overwrite(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return;
  throw UsageError(fmt::format("--checkpoint {}: it exists already; continue it with --resume {}, or remove it first",
                               path.string(), path.string()));
}

/// Refuses another part of the render, which no fact tells.
void refuse_another_part(const CheckpointFile::Render& then, const CheckpointFile::Render& now,
                         const std::string& file) {
  if (then.part != now.part)
    throw UsageError(
        fmt::format("--resume {}: it holds {}, and this run is {}, which begins with a --checkpoint of its own", file,
                    then.part.in_words(), now.part.in_words()));
  if (then.memory != now.memory)
    throw UsageError(fmt::format("--resume {}: parts keep their bound on memory, here {}", file,
                                 then.memory == 0 ? "none" : fmt::format("--memory {}", then.memory)));
}

/// Leaves a file to others if it is not this run's.
void leave_to_others(const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) throw WriteError(path, "another program has put a file of its own there");
}

}  // namespace

Checkpoints::Checkpoints(const Job& job, const std::string& sampling, const CheckpointSettings& settings,
                         std::unique_ptr<const CheckpointFile> resumed, Messages& messages)
    : messages_(messages),
      is_spectral_(job.settings.spectral),
      path_(settings.checkpoint.empty() ? settings.resume : settings.checkpoint),
      every_(settings.checkpoint_every.value_or(kEvery)),
      schedule_(every_),
      last_(std::move(resumed)) {
  if (!writes()) return;
  if (settings.resume.empty() || !is_same_file(path_, settings.resume)) refuse_to_overwrite(path_);
  render_ = {facts_of(job, all_frames(job)), frames_to_keep(job), sampling, settings.part};
  if (!settings.part.is_all()) render_.memory = settings.memory, render_.words = settings.words;
  render_.machines = {machine_in_words()};
  if (last_ == nullptr) return;
  refuse_another_part(last_->render(), render_, settings.resume);
  for (const std::string& machine : last_->render().machines)
    if (machine != render_.machines.front()) render_.machines.push_back(machine);
  const Changes changes(job, last_->render(), sampling);
  has_changed_ = changes.any();
  for (const IntervalState& state : last_->intervals())
    if (!is_among(changes.anew(state.places), job.frames)) changes.refuse_only_new(messages);
  messages_.show(changes.warnings());
  for (const IntervalState& state : last_->intervals())
    if (Places now = changes.after(state.places); !now.going_on().empty()) {
      states_.push_back(state);
      states_.back().places = std::move(now);
    }
  expect_frames(states_, settings.resume);
  while (kept_ < states_.size() && !is_among(states_[kept_].places.going_on(), job.frames)) ++kept_;
}

/// Removes what a run that could not begin has written: it must not stand in the way of the next.
Checkpoints::~Checkpoints() {
  std::error_code ignored;
  if (takes_name_ && std::uncaught_exceptions() > 0 && last_ != nullptr && last_->is_at(path_))
    fs::remove(path_, ignored);
}

std::vector<Places> Checkpoints::begun() const {
  std::vector<Places> places;
  for (std::size_t i = kept_; i < states_.size(); ++i) places.push_back(states_[i].places);
  return places;
}

double Checkpoints::seconds() const {
  double sum = 0;
  for (std::size_t i = kept_; i < states_.size(); ++i) sum += states_[i].seconds;
  return sum;
}

void Checkpoints::begin(const std::vector<FrameList>& intervals, Integrator& first) {
  if (!writes()) return;
  const std::optional<std::uint64_t> bytes = state_bytes(first);
  if (!bytes) throw UsageError("--checkpoint: this integrator does not support checkpoints (Integrator::persist)");
  const std::uint64_t all = bytes_of_all(intervals, *bytes);
  const std::size_t before = states_.size();
  for (std::size_t i = before - kept_; i < intervals.size(); ++i) states_.push_back({{intervals[i]}});
  if (before > 0 && states_.size() > before) {
    std::size_t added = 0;
    for (std::size_t i = before; i < states_.size(); ++i) added += states_[i].places.frames.size();
    messages_.say("{} {} the checkpoint's", counted(added, "frame"), has_changed_ ? "start beside" : "added to");
  }
  std::error_code ignored;
  AtomicFile(path_).reserve(all + (fs::exists(path_, ignored) ? fs::file_size(path_) : 0));
  // Takes the name at once, and keeps the resumed state even if nothing is left to do.
  takes_name_ = last_ == nullptr;
  if (last_ == nullptr || !last_->is_at(path_) || states_.size() > before || has_changed_) {
    if (last_ == nullptr || !last_->is_at(path_)) leave_to_others(path_);
    last_ = CheckpointFile::write(path_, render_, states_, nullptr, last_.get());
  }
  messages_.say("checkpoint: {}, {}, every {}", path_.string(), readable_bytes(all), in_words(every_));
}

IntervalProgress Checkpoints::resume(std::size_t interval, Integrator& integrator) {
  if (!writes()) return {.index = interval};
  const IntervalState& state = states_[kept_ + interval];
  schedule_.begin(state.iterations);
  if (state.iterations == 0) return {.index = interval};
  last_->load(kept_ + interval, integrator);
  try {
    expect_images(integrator, static_cast<int>(state.places.going_on().size()), is_spectral_);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("checkpoint {}: {}", last_->path().string(), error.what()));
  }
  messages_.say(
      "resumed after iteration {}{}", state.iterations,
      states_.size() > 1 ? fmt::format(" of frame interval {}/{}", interval + 1, states_.size() - kept_) : "");
  return {.index = interval, .iterations = state.iterations, .seconds = state.seconds};
}

void Checkpoints::save(const IntervalProgress& progress, Integrator& integrator) {
  if (!writes()) return;
  std::vector<IntervalState> states = last_->intervals();
  for (std::size_t i = 0; i < states.size(); ++i) states[i].places = states_[i].places;
  IntervalState& state = states[kept_ + progress.index];
  state.iterations = progress.iterations, state.seconds = progress.seconds;
  if (!last_->is_at(path_)) leave_to_others(path_);
  takes_name_ = false;
  const CheckpointFile::NewState saved{kept_ + progress.index, integrator};
  last_ = CheckpointFile::write(path_, render_, std::move(states), &saved, last_.get());
}

}  // namespace dspm
