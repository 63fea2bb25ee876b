#include "dspm/session/checkpoint/merged_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "dspm/base/system/readable.h"
#include "dspm/integrators/possible_state.h"
#include "dspm/session/job/frame_choice.h"

namespace dspm {
namespace {

constexpr const char* kSameForAll = "parts are merged only with the scene and the options that they were rendered with";

std::string name_of(const CheckpointFile& file) { return file.path().string(); }

bool are_same(const KnownFrames& a, const KnownFrames& b) {
  return a.moments == b.moments && a.names == b.names && a.base.moments == b.base.moments &&
         a.base.combinations == b.base.combinations;
}

bool have_same_intervals(const CheckpointFile& a, const CheckpointFile& b) {
  const auto same = [](const IntervalState& x, const IntervalState& y) { return x.places.frames == y.places.frames; };
  return std::equal(a.intervals().begin(), a.intervals().end(), b.intervals().begin(), b.intervals().end(), same) &&
         are_same(a.render().frames, b.render().frames);
}

std::string bound_of(const CheckpointFile& file) {
  return file.render().memory == 0 ? "no bound on memory" : fmt::format("--memory {}", file.render().memory);
}

[[noreturn]] void refuse(const std::string& why) { throw UsageError("--merge: " + why); }

}  // namespace

MergedParts::MergedParts(const std::vector<std::string>& files) {
  for (const std::string& file : files) files_.push_back(std::make_unique<const CheckpointFile>(file));
  std::stable_sort(files_.begin(), files_.end(),
                   [](const auto& a, const auto& b) { return a->render().part.number < b->render().part.number; });
  expect_one_render();
}

void MergedParts::expect_one_render() const {
  const CheckpointFile& first = *files_.front();
  for (std::size_t i = 1; i < files_.size(); ++i) {
    const CheckpointFile& file = *files_[i];
    const Part part = file.render().part, before = files_[i - 1]->render().part;
    if (part.of != before.of)
      refuse(fmt::format("{} holds {}, {} holds {}", name_of(*files_[i - 1]), before.in_words(), name_of(file),
                         part.in_words()));
    if (part == before)
      refuse(fmt::format("{} and {} both hold {}", name_of(*files_[i - 1]), name_of(file), part.in_words()));
    if (file.render().memory != first.render().memory)
      refuse(fmt::format("{} was rendered with {}, {} with {}", name_of(first), bound_of(first), name_of(file),
                         bound_of(file)));
    if (!have_same_intervals(file, first))
      refuse(fmt::format("{} and {} do not hold the same frames in the same intervals", name_of(first), name_of(file)));
  }
}

void MergedParts::expect_same(const Job& job) {
  Diagnostics diagnostics;
  const KnownFrames& then = render().frames;
  const MovedFrames places(then, job.description->frames);
  for (std::size_t c = 0; c < places.combinations().size(); ++c)
    if (!places.combinations()[c])
      diagnostics.error({}, fmt::format("variation {} of the parts is not there any more", then.names[c]), kSameForAll);
  diagnostics.throw_if_errors();
  const std::vector<Fact> now = facts_of(job, then.all());
  for (const auto& file : files_) compare(file->render().facts, now, diagnostics, {file->path().c_str(), kSameForAll});
  diagnostics.throw_if_errors();
  is_spectral_ = job.settings.spectral;
  expect_frames(files_.front()->intervals(), name_of(*files_.front()));
  for (const IntervalState& state : files_.front()->intervals()) intervals_.push_back(places.of(state.places.frames));
}

std::vector<int> MergedParts::missing() const {
  std::vector<int> numbers;
  auto file = files_.begin();
  for (int number = 1; number <= render().part.of; ++number)
    if (file != files_.end() && (*file)->render().part.number == number)
      ++file;
    else
      numbers.push_back(number);
  return numbers;
}

bool MergedParts::are_whole() const {
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    const int all = progress(i).iterations;
    for (const auto& file : files_)
      if (file->intervals()[i].iterations != file->render().part.share_of(all)) return false;
  }
  return missing().empty();
}

void MergedParts::describe(Messages& messages) const {
  const std::vector<int> lost = missing();
  if (!lost.empty())
    messages.warn(fmt::format("{} {} of {} {} missing: the images are those of the others' iterations",
                              lost.size() == 1 ? "part" : "parts", fmt::join(lost, ", "), render().part.of,
                              lost.size() == 1 ? "is" : "are"));
  else if (!are_whole())
    for (const auto& file : files_)
      messages.say("{}: {}, {}", name_of(*file), file->render().part.in_words(),
                   counted(static_cast<std::size_t>(file->intervals().front().iterations), "iteration"));
  std::set<std::string> machines;
  for (const auto& file : files_) machines.insert(file->render().machines.begin(), file->render().machines.end());
  if (machines.size() > 1)
    messages.say("the parts come from machines that may round differently: {}", fmt::join(machines, "; "));
}

IntervalProgress MergedParts::progress(std::size_t interval) const {
  IntervalProgress sum{.index = interval};
  for (const auto& file : files_) {
    sum.iterations += file->intervals()[interval].iterations;
    sum.seconds += file->intervals()[interval].seconds;
  }
  return sum;
}

void MergedParts::load(std::size_t interval, Integrator& integrator) const {
  bool is_first = true;
  for (const auto& file : files_) {
    if (file->intervals()[interval].iterations == 0) continue;
    is_first ? file->load(interval, integrator) : file->add(interval, integrator);
    is_first = false;
  }
  expect_images(integrator, static_cast<int>(intervals()[interval].size()), is_spectral_);
}

}  // namespace dspm
