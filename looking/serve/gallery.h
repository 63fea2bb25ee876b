// The pictures that viewers look at, between the threads that serve them and the one that renders. A viewer's request
// waits here and is its wish, and stays its wish a moment longer while the answer is on its way. Pictures that nobody
// wishes for are not taken.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "dspm/looking/serve/picture.h"

namespace dspm {

class Gallery {
 public:
  using Clock = std::chrono::steady_clock;
  using Pictures = std::vector<std::shared_ptr<const Picture>>;
  /// A picture that a viewer looks at, and the versions that it has of that, and of the same in other sizes; 0 if it
  /// has none.
  struct Seen {
    Wish wish;
    std::uint64_t version = 0, other = 0;
  };
  struct Request {
    std::uint64_t viewer = 0;  // a number that each chooses
    std::vector<Seen> seen;
  };

  /// Returns the pictures that are newer, or none once patience is over or the viewer has another request. A picture of
  /// the same frame and output in another size stands in for one that was not taken.
  Pictures newer(const Request& request, std::chrono::milliseconds patience);

  static constexpr int kNewer = std::numeric_limits<int>::max();
  /// A viewer with an answer asks again within this time.
  static constexpr std::chrono::milliseconds kMoment{1000};
  /// Returns the wishes of which there is no picture of this run after that many iterations.
  std::vector<Wish> wanted(int iterations = kNewer, Clock::time_point now = Clock::now()) const;
  /// Gives the pictures their versions, and hands them over.
  void put(std::vector<Picture> pictures);
  /// Begins a run of that many frames. The pictures so far are of another run: they stay until there are others.
  void begin_run(int frames);
  /// Ends all waiting.
  void close();

 private:
  struct Hung {
    std::shared_ptr<const Picture> picture;
    Clock::time_point wished = {};  // when the last request for it ended
  };
  void begin_waiting(const std::vector<Seen>& seen);
  void end_waiting(const std::vector<Seen>& seen);
  Pictures newer_now(const std::vector<Seen>& seen);
  const Hung* find(const Seen& seen) const;
  bool is_up_to_date(const Picture& picture, int iterations) const;
  void drop_unused();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<Wish, int> waiting_;                     // by how many
  std::map<std::uint64_t, std::uint64_t> viewers_;  // the last request of each that waits
  std::map<Wish, Hung> pictures_;
  std::uint64_t version_ = 0, requests_ = 0;
  std::size_t bytes_ = 0;
  int run_ = 0, frames_ = 0;
  bool closed_ = false;
};

}  // namespace dspm
