#include "dspm/looking/serve/gallery.h"

#include <algorithm>
#include <cstdlib>

namespace dspm {
namespace {

constexpr std::size_t kMostBytes = std::size_t{256} << 20;  // of pictures that nobody looks at any longer

}  // namespace

Gallery::Pictures Gallery::newer(const Request& request, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const std::uint64_t number = viewers_[request.viewer] = ++requests_;
  changed_.notify_all();  // for the viewer's earlier request
  begin_waiting(request.seen);
  Pictures pictures;
  const auto is_last = [&] { return viewers_[request.viewer] == number; };
  changed_.wait_for(lock, patience, [&] {
    pictures = newer_now(request.seen);
    return closed_ || !is_last() || !pictures.empty();
  });
  end_waiting(request.seen);
  if (is_last()) viewers_.erase(request.viewer);
  return pictures;
}

void Gallery::begin_waiting(const std::vector<Seen>& seen) {
  for (const Seen& each : seen) ++waiting_[each.wish];
}

void Gallery::end_waiting(const std::vector<Seen>& seen) {
  for (const Seen& each : seen) {
    if (const auto found = waiting_.find(each.wish); --found->second == 0) waiting_.erase(found);
    if (const auto found = pictures_.find(each.wish); found != pictures_.end()) found->second.wished = Clock::now();
  }
}

Gallery::Pictures Gallery::newer_now(const std::vector<Seen>& seen) {
  Pictures pictures;
  for (const Seen& each : seen)
    if (const Hung* hung = find(each))
      if (std::find(pictures.begin(), pictures.end(), hung->picture) == pictures.end())
        pictures.push_back(hung->picture);
  return pictures;
}

/// Returns the picture itself, else that of the nearest size, if it is newer.
const Gallery::Hung* Gallery::find(const Seen& seen) const {
  const Wish& wish = seen.wish;
  if (const auto exact = pictures_.find(wish); exact != pictures_.end())
    return exact->second.picture->version > seen.version ? &exact->second : nullptr;
  const Hung* best = nullptr;
  for (auto at = pictures_.lower_bound({wish.frame, wish.output, 0});
       at != pictures_.end() && at->first.frame == wish.frame && at->first.output == wish.output; ++at)
    if (best == nullptr ||
        std::abs(at->first.halvings - wish.halvings) <= std::abs(best->picture->wish.halvings - wish.halvings))
      best = &at->second;
  return best != nullptr && best->picture->version > seen.other ? best : nullptr;
}

bool Gallery::is_up_to_date(const Picture& picture, int iterations) const {
  return picture.run == run_ && picture.iterations >= iterations && !(picture.shrunk && iterations > 0);
}

std::vector<Wish> Gallery::wanted(int iterations, Clock::time_point now) const {
  const std::lock_guard lock(mutex_);
  std::vector<Wish> wishes;
  for (const auto& [wish, count] : waiting_)
    if (wish.frame < frames_ && !pictures_.contains(wish)) wishes.push_back(wish);
  for (const auto& [wish, hung] : pictures_) {
    const bool is_wished = waiting_.contains(wish) || now < hung.wished + kMoment;
    if (is_wished && !is_up_to_date(*hung.picture, iterations)) wishes.push_back(wish);
  }
  return wishes;
}

void Gallery::put(std::vector<Picture> pictures) {
  const std::lock_guard lock(mutex_);
  for (Picture& picture : pictures) {
    picture.version = ++version_, picture.run = run_;
    Hung& hung = pictures_[picture.wish];
    if (hung.picture != nullptr) bytes_ -= hung.picture->pixels.size();
    bytes_ += picture.pixels.size();
    hung.picture = std::make_shared<const Picture>(std::move(picture));
  }
  drop_unused();
  changed_.notify_all();
}

/// Drops the oldest pictures, as long as there are too many, but never one that somebody waits for.
void Gallery::drop_unused() {
  while (bytes_ > kMostBytes) {
    auto oldest = pictures_.end();
    for (auto at = pictures_.begin(); at != pictures_.end(); ++at)
      if (!waiting_.contains(at->first) &&
          (oldest == pictures_.end() || at->second.picture->version < oldest->second.picture->version))
        oldest = at;
    if (oldest == pictures_.end()) return;
    bytes_ -= oldest->second.picture->pixels.size();
    pictures_.erase(oldest);
  }
}

void Gallery::begin_run(int frames) {
  const std::lock_guard lock(mutex_);
  ++run_, frames_ = frames;
  for (const auto& [wish, hung] : pictures_)
    if (wish.frame >= frames) bytes_ -= hung.picture->pixels.size();
  std::erase_if(pictures_, [&](const auto& each) { return each.first.frame >= frames; });
}

void Gallery::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

}  // namespace dspm
