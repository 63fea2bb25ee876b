// Follows paths on a machine, one wave after the other, to their ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/system/untouched.h"
#include "dspm/integrators/waves/machine.h"
#include "dspm/integrators/waves/wave_lists.h"

namespace dspm {

/// State is that of a path; Left are what else steps append to lists. Memory is kept from one call to the next.
template <class Machine, class State, class... Left>
class FollowedWaves {
 public:
  explicit FollowedWaves(Machine& machine)
      : machine_(machine), now_(machine), lists_(machine), sums_(machine), sums_before_(machine), parted_(machine) {}

  /// `steps` (wave_steps.h) has all but states, lists and sums, of which each group has `width`. Starts have numbers below
  /// `paths`.
  template <class Steps>
  void follow(Steps steps, std::span<const State> starts, std::uint32_t paths, std::size_t width) {
    now_.copy_in(starts);
    parted_.reserve(paths), machine_.clear(parted_.data(), paths);
    lists_.clear(), groups_ = 0, width_ = width;
    for (std::size_t count = starts.size(); count > 0;) {
      take(steps, count);
      count = lists_.template size<State>();
      lists_.swap(now_);
    }
  }

  /// Gives all memory back.
  void release() { now_.release(), lists_.release(), sums_.release(), sums_before_.release(), parted_.release(); }

  /// Returns what is in the list of T, in its order().
  template <class T>
  UntouchedVector<T> sorted() {
    return lists_.template sorted<T>();
  }

  std::vector<std::uint8_t> parted(std::uint32_t paths) {
    std::vector<std::uint8_t> flags(paths);
    parted_.copy_out(flags);
    return flags;
  }

  /// Returns the sums over all groups.
  std::vector<std::int64_t> sums() {
    std::vector<std::int64_t> all(groups_ * width_), total(width_);
    sums_.copy_out(all);
    for (std::size_t i = 0; i < all.size(); ++i) total[i % width_] += all[i];
    return total;
  }

 private:
  /// Takes the step of each path of a wave.
  template <class Steps>
  void take(Steps& steps, std::size_t count) {
    make_sums(count);
    steps.paths = now_.data(), steps.parted = parted_.data(), steps.sums = sums_.data();
    machine_.copy(sums_before_.data(), sums_.data(), bytes_of_sums());
    lists_.append(
        count,
        [&](const WaveList<State>& next, const WaveList<Left>&... left) {
          steps.next = next;
          steps.append_to(left...);
          machine_.for_each(count, steps);
        },
        [&] { machine_.copy(sums_.data(), sums_before_.data(), bytes_of_sums()); });
  }

  void make_sums(std::size_t count) {
    const std::size_t groups = (count + kSharers - 1) / kSharers;
    if (groups <= groups_) return;
    sums_.reserve(groups * width_, groups_ * width_), sums_before_.reserve(groups * width_);
    machine_.clear(sums_.data() + groups_ * width_, (groups - groups_) * width_ * sizeof(std::int64_t));
    groups_ = groups;
  }
  std::size_t bytes_of_sums() const { return groups_ * width_ * sizeof(std::int64_t); }

  Machine& machine_;
  MachineArray<State, Machine> now_;
  WaveLists<Machine, State, Left...> lists_;  // the first is that of the next wave
  MachineArray<std::int64_t, Machine> sums_, sums_before_;
  std::size_t groups_ = 0, width_ = 0;
  MachineArray<std::uint8_t, Machine> parted_;
};

}  // namespace dspm
