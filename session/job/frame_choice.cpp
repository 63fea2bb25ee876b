#include "dspm/session/job/frame_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/glob.h"

namespace dspm {
namespace {

constexpr std::size_t kNamesListed = 10;

bool matches_any(const Glob& glob, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return glob.matches(name); });
}

/// Returns a hint for a pattern that matches nothing.
std::string names_in_words(const std::string& pattern, const std::vector<Combination>& combinations) {
  std::vector<std::string> names;
  for (const Combination& each : combinations) names.push_back(each.name);
  for (const std::string& wider : {pattern + "-*", "*-" + pattern, "*-" + pattern + "-*"})
    if (matches_any(Glob(wider), names)) return fmt::format("did you mean '{}'?", wider);
  if (const std::string guess = did_you_mean(pattern, names); !guess.empty()) return guess;
  std::string list = "the scene has: ";
  for (std::size_t i = 0; i < std::min(names.size(), kNamesListed); ++i) list += (i > 0 ? ", " : "") + names[i];
  return list + (names.size() > kNamesListed ? ", ... (--list-variations prints all)" : "");
}

std::vector<bool> chosen_variations(const SceneDescription& description, const std::vector<std::string>& patterns) {
  const std::vector<Combination>& combinations = description.frames.combinations();
  std::vector<bool> chosen(combinations.size(), patterns.empty());
  for (const std::string& pattern : patterns) {
    if (description.axes.empty()) throw UsageError(fmt::format("--variation {}: the scene has no variations", pattern));
    const Glob glob(pattern);
    bool any = false;
    for (std::size_t c = 0; c < combinations.size(); ++c)
      if (glob.matches(combinations[c].name)) any = chosen[c] = true;
    if (any) continue;
    // If there are too many combinations to make them all, the list holds only those that another pattern chose.
    throw UsageError(fmt::format("--variation {}: there is no such variation{}", pattern,
                                 combinations.empty() ? "" : "; " + names_in_words(pattern, combinations)));
  }
  return chosen;
}

/// Returns which frames of the file an earlier run rendered. After errors, some may be missing.
std::vector<bool> rendered_before(const FileFrames& file, const Choices& choices) {
  std::vector<bool> rendered(static_cast<std::size_t>(file.count()));
  if (!choices.known) return rendered;
  for (const FileFrame frame : MovedFrames(*choices.known, file).of(choices.known->rendered))
    if (frame.slot() < rendered.size()) rendered[frame.slot()] = true;
  return rendered;
}

}  // namespace

MovedFrames::MovedFrames(const KnownFrames& known, const FileFrames& now) : now_(now), then_(known) {
  std::map<std::string_view, int> places;
  for (std::size_t c = 0; c < now.combinations().size(); ++c)
    places.emplace(now.combinations()[c].name, static_cast<int>(c));
  for (const std::string& name : known.names) {
    const auto found = places.find(name);
    combinations_.push_back(found == places.end() ? std::nullopt : std::optional(found->second));
  }
}

std::optional<FileFrame> MovedFrames::at(FileFrame frame) const {
  const std::optional<int> combination = combinations_[then_.combination_of(frame)];
  if (!combination) return std::nullopt;
  return now_.frame(*combination, then_.moment_index(frame));
}

std::vector<FileFrame> MovedFrames::of(const std::vector<FileFrame>& frames) const {
  std::vector<FileFrame> result;
  for (const FileFrame frame : frames)
    if (const std::optional<FileFrame> now = at(frame)) result.push_back(*now);
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<FileFrame> chosen_frames(const SceneDescription& description, const Choices& choices) {
  const FileFrames& file = description.frames;
  if (!choices.frames.empty() && choices.frames.back() > file.last_moment())
    throw UsageError(fmt::format("--frames: there is no frame {}, the last one is {}", choices.frames.back().number(),
                                 file.last_moment().number()));
  if (!choices.frames.empty() && choices.frames.front() < file.first_moment())
    throw UsageError(fmt::format("--frames: there is no frame {}, the first one is {}", choices.frames.front().number(),
                                 file.first_moment().number()));
  const std::vector<bool> chosen = chosen_variations(description, choices.variations);
  const std::vector<bool> rendered = rendered_before(file, choices);
  std::vector<FileFrame> frames;
  bool adds = false, leaves_out = false;
  for (FileFrame f(0); f.index() < file.count(); ++f) {
    const bool in_time =
        choices.frames.empty() || std::binary_search(choices.frames.begin(), choices.frames.end(), file.moment(f));
    const bool is_chosen = in_time && chosen[file.combination_of(f)];
    if (is_chosen && !rendered[f.slot()]) adds = true;
    if (!is_chosen && rendered[f.slot()]) leaves_out = true;
    if (rendered[f.slot()] ? !choices.only_new : is_chosen) frames.push_back(f);
  }
  if (leaves_out && !adds && !choices.only_new)  // those that are new are added to the checkpoint's
    throw UsageError(
        fmt::format("{}: the checkpoint's frames go on together, and these are only some of them; leave it out, "
                    "or render them on their own, without --resume",
                    choices.frames.empty() ? "--variation" : "--frames"));
  if (frames.empty() && choices.only_new)
    throw NothingNew("--only-new: the checkpoint holds all chosen frames already");
  return frames;
}

}  // namespace dspm
