#include "dspm/base/colour/interference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/colour/observer.h"

namespace dspm {
namespace {

constexpr int kStepNm = 10, kSteps = 2000;

/// In the last quarter the colours fade out: what is left there is the grain of whole nanometres.
const std::array<Rgb, kSteps + 1>& colours() {
  static const auto table = [] {
    std::array<Rgb, kSteps + 1> all;
    for (int i = 0; i <= kSteps; ++i) {
      const double turn = 2 * std::acos(-1.) * i * kStepNm, left = std::min(1., 4. * (kSteps - i) / kSteps);
      const auto rgb = under_daylight([&](int nm) { return std::cos(turn / nm); });
      for (int c = 0; c < 3; ++c)
        all[static_cast<std::size_t>(i)][c] = static_cast<float>(rgb[static_cast<std::size_t>(c)] * left);
    }
    return all;
  }();
  return table;
}

}  // namespace

Rgb interference(float path_nm) {
  const float x = std::abs(path_nm) / kStepNm;
  if (!(x < kSteps)) return {};
  const auto i = static_cast<std::size_t>(x);
  const float t = x - static_cast<float>(i);
  return colours()[i] * (1 - t) + colours()[i + 1] * t;
}

}  // namespace dspm
