#include "dspm/session/machines/desk.h"

#include <algorithm>
#include <utility>

namespace dspm {

void Desk::open(int begin, int all, int size) {
  blocks_.clear();
  open_ = true, next_ = begin, all_ = all, size_ = size;
}

std::optional<Block> Desk::hand_out(int machine) {
  const auto held = std::count_if(blocks_.begin(), blocks_.end(), [&](const auto& each) {
    return each.second.machine == machine && each.second.is_rendered;
  });
  if (!open_) return std::nullopt;
  if (held >= kMostHeld) return once_more(machine);
  if (all_ > 0 && next_ >= all_) return std::nullopt;
  const Block block = Block::from(next_, all_, size_);
  next_ = block.end;
  blocks_.emplace(block.begin, Entry{block, machine});
  return block;
}

std::optional<Block> Desk::once_more(int machine) {
  Entry& first = blocks_.begin()->second;  // there is one, as the machine holds some
  if (first.is_rendered || first.machine == machine || first.other != kNobody) return std::nullopt;
  first.other = machine;
  return first.block;
}

void Desk::rendered(int machine, int begin) {
  const auto found = blocks_.find(begin);
  if (found == blocks_.end()) return;
  Entry& entry = found->second;
  if (entry.is_rendered || (entry.machine != machine && entry.other != machine)) return;
  entry.machine = machine, entry.is_rendered = true;
}

std::vector<Desk::Fetch> Desk::to_fetch() {
  std::vector<Fetch> fetches;
  auto here = std::count_if(blocks_.begin(), blocks_.end(), [](const auto& each) { return each.second.is_fetched; });
  for (auto& [begin, entry] : blocks_) {
    const bool has_room = here < kAhead || begin == wanted_from();
    if (!entry.is_rendered || entry.is_fetched || !has_room) continue;
    entry.is_fetched = true, ++here;
    fetches.push_back({entry.machine, begin});
  }
  return fetches;
}

void Desk::arrived(int begin, std::string state) {
  const auto found = blocks_.find(begin);
  if (found == blocks_.end()) return;
  found->second.is_rendered = found->second.is_fetched = true;
  found->second.state = std::move(state);
}

bool Desk::is_here(int begin) const {
  const auto found = blocks_.find(begin);
  return found != blocks_.end() && found->second.state;
}

std::optional<std::string> Desk::take(int begin) {
  if (!is_here(begin)) return std::nullopt;
  return blocks_.extract(begin).mapped().state;
}

}  // namespace dspm
