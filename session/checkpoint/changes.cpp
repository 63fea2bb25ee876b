#include "dspm/session/checkpoint/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

constexpr std::size_t kNamesListed = 10;

using Marks = std::vector<bool>;

std::string names_in_words(const std::vector<std::string>& names, const Marks& marks) {
  std::string list;
  std::size_t count = 0;
  for (std::size_t c = 0; c < names.size(); ++c)
    if (marks[c] && ++count <= kNamesListed) list += (count > 1 ? ", " : "") + names[c];
  return count > kNamesListed ? fmt::format("{} and {} more", list, count - kNamesListed) : list;
}

bool has_any(const Marks& marks) { return std::find(marks.begin(), marks.end(), true) != marks.end(); }

Marks removed(const MovedFrames& moved) {
  Marks marks;
  for (const std::optional<int>& now : moved.combinations()) marks.push_back(!now);
  return marks;
}

bool chooses(const SceneDescription& description, int combination, const std::string& variation) {
  const std::vector<int>& choices = description.frames.combinations()[static_cast<std::size_t>(combination)].choices;
  for (std::size_t axis = 0; axis < choices.size(); ++axis)
    if (description.axes[axis].variations[static_cast<std::size_t>(choices[axis])].name == variation) return true;
  return false;
}

/// Returns whether the difference matters to each earlier combination; nullopt if it matters to all, or if that is not
/// known.
std::optional<Marks> matters_to(const Difference& difference, const std::vector<std::string>& names,
                                const MovedFrames& moved, const SceneDescription& description) {
  const Fact& fact = difference.now != nullptr ? *difference.now : *difference.then;
  Marks marks(names.size());
  switch (fact.scope) {
    case Fact::Scope::all: return std::nullopt;
    case Fact::Scope::file:  // whoever names another file has changed, too
      if (difference.now != nullptr && difference.then != nullptr) return std::nullopt;
      return marks;
    case Fact::Scope::combination:
      for (std::size_t c = 0; c < marks.size(); ++c) marks[c] = names[c] == fact.of;
      return marks;
    case Fact::Scope::variation:
      for (std::size_t c = 0; c < marks.size(); ++c)
        if (const std::optional<int> now = moved.combinations()[c]) marks[c] = chooses(description, *now, fact.of);
      return marks;
  }
  return std::nullopt;
}

std::string removed_in_words(const std::vector<std::string>& names, const Marks& gone) {
  return fmt::format("{} of the checkpoint, not there any more", names_in_words(names, gone));
}

constexpr const char* kSampling =
    "how lights are chosen, or the sphere around everything, has changed since the checkpoint";
constexpr const char* kSamplingWayOut =
    "the frames that it was begun with decide that for all; leave their lights, and what lies farthest out, as they "
    "were, or start over with another checkpoint";

}  // namespace

Changes::Changes(const Job& job, const CheckpointFile::Render& then, const std::string& sampling)
    : moved_(then.frames, job.description->frames), anew_(removed(moved_)) {
  const std::vector<std::string>& names = then.frames.names;
  const Marks gone = anew_;
  const FramesPart part{then.frames.moments, static_cast<int>(std::count(gone.begin(), gone.end(), false))};
  const std::vector<Fact> facts = facts_of(job, part);
  bool only_some = then.part.is_all();
  if (has_any(gone)) diagnostics_.warning({}, "given up: " + removed_in_words(names, gone));
  const std::vector<Difference> found = differences(then.facts, facts);
  for (const Difference& each : found) {
    const std::optional<Marks> marks = matters_to(each, names, moved_, *job.description);
    if (!marks) only_some = false;
    if (!marks || !has_any(*marks)) continue;
    for (std::size_t c = 0; c < anew_.size(); ++c) anew_[c] = anew_[c] || (*marks)[c];
    diagnostics_.warning(each.where(), each.in_words(), "these start anew: " + names_in_words(names, *marks));
  }
  if (found.empty() && !has_any(gone)) return;
  const bool goes_on = std::find(anew_.begin(), anew_.end(), false) != anew_.end();
  if (only_some && has_any(anew_) && goes_on && then.sampling == sampling) return;
  Diagnostics errors;  // all that has changed
  compare(then.facts, facts, errors);
  if (has_any(gone)) errors.error({}, removed_in_words(names, gone), Since().way_out);
  if (only_some && then.sampling != sampling) errors.error({}, kSampling, kSamplingWayOut);
  errors.throw_if_errors();
}

void Changes::refuse_only_new(Messages& messages) const {
  messages.show(diagnostics_);
  throw UsageError("--only-new: what has changed is not new; resume without --only-new, which renders it anew");
}

Places Changes::after(const Places& then) const {
  Places now = then;
  std::optional<FileFrame> stand_in;
  for (std::size_t j = 0; j < then.frames.size(); ++j) {
    const auto frame = static_cast<Frame>(j);
    if (!goes_on(then.frames[j])) now.given_up |= FrameSet::single(frame);
    if (now.given_up.contains(frame)) continue;
    now.frames[j] = *moved_.at(then.frames[j]);
    if (!stand_in) stand_in = now.frames[j];
  }
  // One that goes on, so that it costs little; the list still ascends.
  for (std::size_t j = 0; stand_in && j < now.frames.size(); ++j)
    if (now.given_up.contains(static_cast<Frame>(j)))
      now.frames[j] = *stand_in;
    else
      stand_in = now.frames[j];
  return now;
}

FrameList Changes::anew(const Places& then) const {
  FrameList frames;
  for (const FileFrame frame : then.going_on())
    if (const std::optional<FileFrame> now = moved_.at(frame); now && !goes_on(frame)) frames.push_back(*now);
  return frames;
}

}  // namespace dspm
