// The lists to which the steps of a wave append, on a machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

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

/// A list for each type of Items. Memory is kept when they are cleared.
template <class Machine, class... Items>
class WaveLists {
 public:
  explicit WaveLists(Machine& machine)
      : machine_(machine),
        items_((static_cast<void>(sizeof(Items)), machine)...),
        sizes_(machine),
        keys_(machine),
        order_(machine) {}

  /// Clears them and gives all memory back.
  void release() {
    clear();
    (array<Items>().release(), ...);
    keys_.release(), order_.release();
  }

  template <class T>
  std::size_t size() const {
    return size_[place_of<T>()];
  }
  void clear() { size_ = {}; }
  template <class T>
  void clear() {
    size_[place_of<T>()] = 0;
  }
  /// Takes the items out of a list, in exchange for the memory of another.
  template <class T>
  void swap(MachineArray<T, Machine>& other) {
    array<T>().swap(other), clear<T>();
  }

  /// Calls append(const WaveList<Items>&...), which appends to the lists: once, and again after undo() with more room as long as
  /// something does not fit. `usual` is the usual number of items.
  template <class Append, class Undo>
  void append(std::size_t usual, const Append& append, const Undo& undo) {
    const Sizes before = size_;
    Sizes room = before;
    for (std::uint32_t& size : room) size += static_cast<std::uint32_t>(usual + usual / 4);
    for (;;) {
      (array<Items>().reserve(room[place_of<Items>()], before[place_of<Items>()]), ...);
      sizes_.copy_in(before);
      append(WaveList<Items>{array<Items>().data(), sizes_.data() + place_of<Items>(),
                             static_cast<std::uint32_t>(array<Items>().room())}...);
      sizes_.copy_out(size_);
      if ((... && (size<Items>() <= array<Items>().room()))) return;
      room = size_;
      for (std::uint32_t& size : room) size += size / 4;
      undo();
    }
  }

  /// Returns a list's items.
  template <class T>
  UntouchedVector<T> items() {
    UntouchedVector<T> to(size<T>());
    array<T>().copy_out(to);
    return to;
  }
  /// Returns them in their order().
  template <class T>
  UntouchedVector<T> sorted() {
    UntouchedVector<T> to(size<T>());
    if (to.empty()) return to;
    const T* const from = array<T>().data();
    keys_.reserve(to.size()), order_.reserve(to.size());
    machine_.for_each(to.size(), OrdersOf<T>{from, keys_.data()});
    machine_.sort(keys_.data(), order_.data(), to.size());
    if constexpr (Machine::kOwnMemory) {
      MachineArray<T, Machine> in_order(machine_);
      in_order.reserve(to.size());
      machine_.for_each(to.size(), PutInOrder<T>{from, order_.data(), in_order.data()});
      in_order.copy_out(to);
    } else {
      machine_.for_each(to.size(), PutInOrder<T>{from, order_.data(), to.data()});
    }
    return to;
  }

 private:
  using Sizes = std::array<std::uint32_t, sizeof...(Items)>;

  template <class T>
  static constexpr std::size_t place_of() {
    constexpr bool kIsIt[] = {std::is_same_v<T, Items>...};
    std::size_t place = 0;
    while (!kIsIt[place]) ++place;
    return place;
  }
  template <class T>
  MachineArray<T, Machine>& array() {
    return std::get<MachineArray<T, Machine>>(items_);
  }
  template <class T>
  const MachineArray<T, Machine>& array() const {
    return std::get<MachineArray<T, Machine>>(items_);
  }

  Machine& machine_;
  std::tuple<MachineArray<Items, Machine>...> items_;
  Sizes size_{};
  MachineArray<std::uint32_t, Machine> sizes_;
  MachineArray<std::uint64_t, Machine> keys_;
  MachineArray<std::uint32_t, Machine> order_;
};

}  // namespace dspm
