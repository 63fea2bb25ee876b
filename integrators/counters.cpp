#include "dspm/integrators/counters.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dspm {

Counters::Entry* Counters::find(std::string_view name) {
  const auto same =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.name == name; });
  return same == entries_.end() ? nullptr : &*same;
}

void Counters::add(std::string_view name, std::uint64_t count) {
  if (Entry* const same = find(name)) {
    same->value += count;
    return;
  }
  if (name.size() > kLongestName) throw std::length_error("the name of a counter is too long");
  if (entries_.size() >= kMost) throw std::length_error("an integrator has too many counters");
  Entry& entry = entries_.emplace_back();
  std::copy(name.begin(), name.end(), entry.name);
  entry.value = count;
}

Counters& Counters::operator+=(const Counters& other) {
  for (const Entry& entry : other.entries_)
    if (entries_.size() < kMost || find(entry.name) != nullptr) add(entry.name, entry.value);
  return *this;
}

void Counters::persist(StateStream& state) {
  const Counters before = state.merges() ? *this : Counters();
  std::vector<Entry> entries = entries_;
  state.list(entries, kMost);
  for (const Entry& entry : entries)
    if (entry.name[kLongestName] != 0) throw std::runtime_error("it holds a counter whose name is too long");
  entries_ = std::move(entries);
  *this += before;
}

}  // namespace dspm
