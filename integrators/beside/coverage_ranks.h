// Counts, by camera paths, how much of a pixel each of a few things covers. Cryptomatte calls these ranks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace dspm {

/// Needs constant memory: if more things show than there is room for, the one with fewest paths makes room for a new
/// one, which begins with one path. So no share is too large, and large ones lose nothing unless many things are
/// larger.
class CoverageRanks {
 public:
  static constexpr std::size_t kRanks = 6;
  struct Share {
    int thing = 0;
    std::uint32_t paths = 0;  // 0: no thing
  };

  void add(int thing) {
    Share* least = &shares_.front();
    for (Share& share : shares_) {
      if (share.paths > 0 && share.thing == thing) return static_cast<void>(++share.paths);
      if (share.paths < least->paths) least = &share;
    }
    *least = {thing, 1};
  }
  /// Keeps the largest shares of both; again, none is too large.
  CoverageRanks& operator+=(const CoverageRanks& other) {
    std::array<Share, 2 * kRanks> all{};
    std::copy(shares_.begin(), shares_.end(), all.begin());
    auto end = all.begin() + kRanks;
    for (const Share& share : other.shares_) {
      const auto same = std::find_if(all.begin(), all.begin() + kRanks, [&](const Share& s) {
        return s.paths > 0 && share.paths > 0 && s.thing == share.thing;
      });
      same == all.begin() + kRanks ? void(*end++ = share) : void(same->paths += share.paths);
    }
    std::stable_sort(all.begin(), all.end(), larger);
    std::copy_n(all.begin(), kRanks, shares_.begin());
    return *this;
  }
  /// Returns the shares, the largest first.
  std::array<Share, kRanks> sorted() const {
    std::array<Share, kRanks> shares = shares_;
    std::stable_sort(shares.begin(), shares.end(), larger);
    return shares;
  }

 private:
  static bool larger(const Share& a, const Share& b) {
    return a.paths != b.paths ? a.paths > b.paths : a.thing < b.thing;
  }

  std::array<Share, kRanks> shares_;
};

}  // namespace dspm
