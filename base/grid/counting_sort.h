// The core of a counting sort shared by several threads.
#pragma once

#include <utility>
#include <vector>

namespace dspm {

/// Replaces counts[t][c], the number of elements of class c in thread t, by the place of the first of them, ordered by
/// class, then thread. begins[c] is the place where class c begins, and the last of `begins` is the total.
template <class Counts, class Begins>
void turn_into_places(std::vector<Counts>& counts, Begins& begins) {
  typename Begins::value_type sum = 0;
  for (std::size_t c = 0; c + 1 < begins.size(); ++c) {
    begins[c] = sum;
    for (Counts& thread : counts) sum += std::exchange(thread[c], sum);
  }
  begins.back() = sum;
}

}  // namespace dspm
