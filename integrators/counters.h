// Counts of a plugin's integrator, by name, for --stats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dspm/base/system/state_stream.h"

namespace dspm {

class Counters {
 public:
  struct Entry {
    char name[24];  // ends with a 0
    std::uint64_t value;
  };
  static constexpr std::size_t kMost = 64, kLongestName = sizeof(Entry::name) - 1;

  /// Searches for the name, so call it for the sum of a chunk of work rather than for each ray. Throws
  /// std::length_error beyond kMost names, or if the name is longer than kLongestName.
  void add(std::string_view name, std::uint64_t count);
  /// Adds the counts of equal names; new names beyond kMost are left out.
  Counters& operator+=(const Counters& other);
  /// Saves names as well: loading replaces all counters.
  void persist(StateStream& state);

  auto begin() const { return entries_.begin(); }
  auto end() const { return entries_.end(); }

 private:
  Entry* find(std::string_view name);

  std::vector<Entry> entries_;
};

}  // namespace dspm
