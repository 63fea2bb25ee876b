#include "dspm/integrators/rejections.h"

#include <algorithm>

namespace dspm {
namespace {

constexpr std::size_t kMostEntries = 16;

}  // namespace

void Rejections::add(const Entry& entry) {
  count_ += entry.count;
  const auto same =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.element == entry.element; });
  if (same == entries_.end()) {
    if (entries_.size() < kMostEntries) entries_.push_back(entry);
    return;
  }
  same->count += entry.count;
  if (same->pixel == kNoPixel && entry.pixel != kNoPixel) same->pixel = entry.pixel, same->frame = entry.frame;
}

Rejections& Rejections::operator+=(const Rejections& other) {
  const std::uint64_t sum = count_ + other.count_;
  for (const Entry& entry : other.entries_) add(entry);
  count_ = sum;
  return *this;
}

void Rejections::persist(StateStream& state) { state.sum(count_); }

}  // namespace dspm
