// How many renders a statistical comparison takes the mean of, or how many random scenes hold a promise: a few in every
// test run, more in ./dev soak.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace dspm::test {

/// `usual`, times DSPM_SEEDS if that is set: twice as many find a fault that is 0.7 as large.
inline int seeds(int usual) {
  const char* const factor = std::getenv("DSPM_SEEDS");
  return factor != nullptr ? usual * std::max(1, std::atoi(factor)) : usual;
}

}  // namespace dspm::test
