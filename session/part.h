// A part of a render that machines share out: every n-th iteration. Iterations are independent of one another, so no
// machine has to hear of the others, and each part alone stands for the whole.
#pragma once

#include <fmt/format.h>

#include <string>

namespace dspm {

struct Part {
  static constexpr int kMost = 1000;  // files that --merge opens together

  int number = 1, of = 1;

  bool is_all() const { return of == 1; }
  /// Returns the number of the iteration that follows `done` iterations of the part; they count from 0.
  int iteration(int done) const { return number - 1 + done * of; }
  /// Returns how many of so many iterations are the part's.
  int share_of(int iterations) const { return (iterations - number + of) / of; }
  std::string in_words() const { return is_all() ? "all iterations" : fmt::format("part {}/{}", number, of); }
  friend bool operator==(const Part&, const Part&) = default;
};

}  // namespace dspm
