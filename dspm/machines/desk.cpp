#include "dspm/machines/desk.h"

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
  if (!open_ || (all_ > 0 && next_ >= all_) || held >= kMostHeld) return std::nullopt;
  const Block block = Block::from(next_, all_, size_);
  next_ = block.end;
  blocks_.emplace(block.begin, Entry{block, machine});
  return block;
}

void Desk::rendered(int machine, int begin) {
  const auto found = blocks_.find(begin);
  if (found != blocks_.end() && found->second.machine == machine) found->second.is_rendered = true;
}

std::vector<Desk::Fetch> Desk::to_fetch() {
  std::vector<Fetch> fetches;
  int ahead = 0;
  for (auto& [begin, entry] : blocks_) {
    if (!entry.is_rendered || ++ahead > kAhead) break;
    if (!std::exchange(entry.is_fetched, true)) fetches.push_back({entry.machine, begin});
  }
  return fetches;
}

void Desk::arrived(int begin, std::string state) {
  const auto found = blocks_.find(begin);
  if (found == blocks_.end()) return;
  found->second.is_rendered = found->second.is_fetched = true;
  found->second.state = std::move(state);
}

std::optional<std::string> Desk::take(int begin) {
  const auto found = blocks_.find(begin);
  if (found == blocks_.end() || !found->second.state) return std::nullopt;
  std::string state = std::move(*found->second.state);
  blocks_.erase(found);
  return state;
}

}  // namespace dspm
