// Photon traces or tiles of pixels whose paths go in the same waves: threads start the paths of different parts side by side,
// and give each part what its paths have left.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/untouched.h"
#include "dspm/integrators/waves/wave_tracer.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

constexpr std::uint32_t start_of(const WavePhoton& photon) { return photon.start; }
constexpr std::uint32_t start_of(const WaveHitPoint& hit) { return hit.start; }
constexpr std::uint32_t start_of(const WaveSight& sight) { return sight.path.start; }
constexpr std::uint32_t start_of(const WaveRejection& rejection) { return rejection.start; }

inline SceneElement element_of(const WaveRejection& rejection) {
  return {rejection.is_shape ? SceneElement::Kind::shape : SceneElement::Kind::material, rejection.index};
}

/// The starts and paths of one part, among those of all.
struct PartRange {
  std::uint32_t first_start = 0, end_start = 0, first_path = 0, end_path = 0;

  /// Returns those of a sorted list that come from the part's starts.
  template <class T>
  std::span<const T> of(const UntouchedVector<T>& all) const {
    const auto from = [&](std::uint32_t start) {
      return std::ranges::partition_point(all, [&](const T& item) { return start_of(item) < start; });
    };
    return {from(first_start), from(end_start)};
  }
  /// Returns the number of the start within the part.
  template <class T>
  std::size_t start(const T& item) const {
    return start_of(item) - first_start;
  }
  /// Returns how many of the part's paths have met something that differs between frames.
  std::uint64_t parted(const WaveOutcome& waves) const {
    const auto flags = std::span(waves.parted).subspan(first_path, end_path - first_path);
    return static_cast<std::uint64_t>(std::ranges::count(flags, 1));
  }
};

/// A Part has states() and paths(): the states of its paths, numbered from 0, and how many paths these are.
template <class Part, class State>
class PartsOfWaves {
 public:
  /// make(i) returns the i-th part of `first` to `end`, as a unique_ptr.
  template <class Make>
  PartsOfWaves(std::size_t first, std::size_t end, const Make& make) : parts_(end - first), ranges_(end - first) {
    for_each_part([&](std::size_t i) { parts_[i] = make(first + i); });
    PartRange range;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      range.first_start = range.end_start, range.end_start += static_cast<std::uint32_t>(parts_[i]->states().size());
      range.first_path = range.end_path, range.end_path += parts_[i]->paths();
      ranges_[i] = range;
    }
    paths_ = range.end_path;
    states_.resize(range.end_start);
    for_each_part([&](std::size_t i) { number(parts_[i]->states(), ranges_[i]); });
  }

  WaveStarts<State> starts(FrameSet frames) const { return {states_, paths_, frames}; }

  /// Calls fn(Part&, const PartRange&) for each part.
  template <class Fn>
  void for_each(const Fn& fn) {
    for_each_part([&](std::size_t i) { fn(*parts_[i], ranges_[i]); });
  }

 private:
  template <class Fn>
  void for_each_part(const Fn& fn) {
    parallel_for(static_cast<std::int64_t>(parts_.size()), 1, [&](std::int64_t i) { fn(static_cast<std::size_t>(i)); });
  }
  void number(std::span<const State> states, const PartRange& range) {
    State* to = states_.data() + range.first_start;
    for (const State& state : states) {
      *to = state;
      to->start += range.first_start, to->path += range.first_path;
      ++to;
    }
  }

  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<PartRange> ranges_;
  UntouchedVector<State> states_;
  std::uint32_t paths_ = 0;
};

}  // namespace dspm
