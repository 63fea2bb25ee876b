// The majority of a row of votes, if there is one, in constant memory. [Boyer and Moore 1981]
#pragma once

#include <cstdint>

namespace dspm {

struct Majority {
  static constexpr int kNone = -1;

  int choice = kNone;
  std::uint32_t lead = 0;

  void vote(int candidate) {
    if (lead == 0) choice = candidate;
    choice == candidate ? ++lead : --lead;
  }
  /// Merges two rows: a majority of all votes remains one. [Agarwal et al. 2012]
  Majority& operator+=(const Majority& o) {
    if (choice == o.choice)
      lead += o.lead;
    else if (lead < o.lead)
      *this = {o.choice, o.lead - lead};
    else
      lead -= o.lead;
    return *this;
  }
};

}  // namespace dspm
