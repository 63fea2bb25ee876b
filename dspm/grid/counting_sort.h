// The heart of a counting sort that several threads share.
#pragma once

#include <utility>
#include <vector>

namespace dspm {

/// counts[t][c]: how many elements of class c thread t has. Turns them into where the first of these goes, class by
/// class and thread by thread; begins[c] is where class c begins, the last of `begins` is the number of all.
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
