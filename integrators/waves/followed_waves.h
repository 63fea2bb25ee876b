// Follows paths on a machine, one wave after the other, to their ends.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "dspm/base/system/untouched.h"
#include "dspm/integrators/waves/machine.h"
#include "dspm/integrators/waves/shared_sums.h"

namespace dspm {

/// Sets keys[i] to the i-th item's order.
template <class T>
struct OrdersOf {
  const T* items;
  std::uint64_t* keys;
  constexpr void operator()(std::size_t i) const { keys[i] = items[i].order(); }
};

template <class T>
struct PutInOrder {
  const T* items;
  const std::uint32_t* order;
  T* to;
  constexpr void operator()(std::size_t i) const { to[i] = items[order[i]]; }
};

/// State is that of a path; Left are what else steps append to lists. Memory is kept from one call to the next.
template <class Machine, class State, class... Left>
class FollowedWaves {
 public:
  explicit FollowedWaves(Machine& machine)
      : machine_(machine),
        now_(machine),
        next_(machine),
        left_((static_cast<void>(sizeof(Left)), machine)...),
        sizes_(machine),
        sums_(machine),
        sums_before_(machine),
        parted_(machine),
        keys_(machine),
        order_(machine) {}

  /// `steps` (wave_steps.h) has all but states, lists and sums, of which each group has `width`. Starts have numbers below
  /// `paths`.
  template <class Steps>
  void follow(Steps steps, std::span<const State> starts, std::uint32_t paths, std::size_t width) {
    now_.copy_in(starts);
    parted_.reserve(paths), machine_.clear(parted_.data(), paths);
    appended_ = {}, groups_ = 0, width_ = width;
    for (std::size_t count = starts.size(); count > 0; count = appended_[0]) {
      take(steps, count);
      now_.swap(next_);
    }
  }

  /// Returns what is in the list of T, in its order().
  template <class T>
  UntouchedVector<T> sorted() {
    MachineArray<T, Machine>& list = std::get<MachineArray<T, Machine>>(left_);
    UntouchedVector<T> to(appended_[place_of<T>()]);
    if (to.empty()) return to;
    keys_.reserve(to.size()), order_.reserve(to.size());
    machine_.for_each(to.size(), OrdersOf<T>{list.data(), keys_.data()});
    machine_.sort(keys_.data(), order_.data(), to.size());
    if constexpr (Machine::kOwnMemory) {
      MachineArray<T, Machine> in_order(machine_);
      in_order.reserve(to.size());
      machine_.for_each(to.size(), PutInOrder<T>{list.data(), order_.data(), in_order.data()});
      in_order.copy_out(to);
    } else {
      machine_.for_each(to.size(), PutInOrder<T>{list.data(), order_.data(), to.data()});
    }
    return to;
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
  static constexpr std::size_t kLists = 1 + sizeof...(Left);  // the first is that of the next wave
  using Sizes = std::array<std::uint32_t, kLists>;

  template <class T>
  static constexpr std::size_t place_of() {
    constexpr bool kIsIt[] = {std::is_same_v<T, Left>...};
    std::size_t place = 0;
    while (!kIsIt[place]) ++place;
    return 1 + place;
  }

  /// Takes the step of each path of a wave: again with more room, if what they left did not fit.
  template <class Steps>
  void take(Steps& steps, std::size_t count) {
    Sizes before = appended_;
    before[0] = 0;
    Sizes wanted = before;
    for (std::uint32_t& size : wanted) size += static_cast<std::uint32_t>(count + count / 4);
    make_sums(count);
    machine_.copy(sums_before_.data(), sums_.data(), groups_ * width_ * sizeof(std::int64_t));
    for (bool fits = false; !fits; wanted = with_reserve(appended_)) {
      make_room(wanted, before);
      sizes_.copy_in(before);
      set(steps);
      machine_.for_each(count, steps);
      sizes_.copy_out(appended_);
      fits = all_fit();
      if (!fits) machine_.copy(sums_.data(), sums_before_.data(), groups_ * width_ * sizeof(std::int64_t));
    }
  }

  static Sizes with_reserve(Sizes sizes) {
    for (std::uint32_t& size : sizes) size += size / 4;
    return sizes;
  }

  void make_sums(std::size_t count) {
    const std::size_t groups = (count + kSharers - 1) / kSharers;
    if (groups <= groups_) return;
    sums_.reserve(groups * width_, groups_ * width_), sums_before_.reserve(groups * width_);
    machine_.clear(sums_.data() + groups_ * width_, (groups - groups_) * width_ * sizeof(std::int64_t));
    groups_ = groups;
  }

  void make_room(const Sizes& wanted, const Sizes& kept) {
    next_.reserve(wanted[0]);
    (std::get<MachineArray<Left, Machine>>(left_).reserve(wanted[place_of<Left>()], kept[place_of<Left>()]), ...);
  }

  bool all_fit() const {
    return appended_[0] <= next_.room() &&
           (... && (appended_[place_of<Left>()] <= std::get<MachineArray<Left, Machine>>(left_).room()));
  }

  template <class Steps>
  void set(Steps& steps) {
    steps.paths = now_.data(), steps.parted = parted_.data(), steps.sums = sums_.data();
    steps.next = list_of(next_, 0);
    steps.append_to(list_of(std::get<MachineArray<Left, Machine>>(left_), place_of<Left>())...);
  }
  template <class T>
  WaveList<T> list_of(MachineArray<T, Machine>& array, std::size_t place) {
    return {array.data(), sizes_.data() + place, static_cast<std::uint32_t>(array.room())};
  }

  Machine& machine_;
  MachineArray<State, Machine> now_, next_;
  std::tuple<MachineArray<Left, Machine>...> left_;
  Sizes appended_{};  // to each list
  MachineArray<std::uint32_t, Machine> sizes_;
  MachineArray<std::int64_t, Machine> sums_, sums_before_;
  std::size_t groups_ = 0, width_ = 0;
  MachineArray<std::uint8_t, Machine> parted_;
  MachineArray<std::uint64_t, Machine> keys_;
  MachineArray<std::uint32_t, Machine> order_;
};

}  // namespace dspm
