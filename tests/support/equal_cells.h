// Numbers that are counted in cells of equal chance.
#pragma once

#include <cstddef>
#include <vector>

#include "dspm/testing/chi2.h"

namespace dspm::test {

/// Returns the cell of a number in [0, 1).
inline std::size_t cell(float u, int cells) { return static_cast<std::size_t>(u * static_cast<float>(cells)); }

/// Returns the chance of a chi-square as large, over cells that all expect the same.
inline double p_value(const std::vector<int>& cells) {
  double count = 0, chi2 = 0;
  for (const int observed : cells) count += observed;
  const double expected = count / static_cast<double>(cells.size());
  for (const int observed : cells) chi2 += (observed - expected) * (observed - expected) / expected;
  return chi2_tail(chi2, static_cast<int>(cells.size()) - 1);
}

}  // namespace dspm::test
