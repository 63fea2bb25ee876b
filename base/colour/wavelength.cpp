#include "dspm/base/colour/wavelength.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "dspm/base/colour/observer.h"
#include "dspm/base/math/rng.h"

namespace dspm {
namespace {

constexpr std::size_t kCount = kLastNm - kFirstNm + 1;

struct Hues {
  std::array<Spectrum, kCount> hue;
  std::array<double, kCount> probability;
  std::array<double, kCount> sums;  // of probabilities, up to and with each

  Hues() {
    const SpectralCurve daylight = *named_spectrum("stdillum-D65");
    std::array<std::array<double, 3>, kCount> colours;
    std::array<double, 3> white{};
    for (std::size_t i = 0; i < kCount; ++i) {
      const int nm = kFirstNm + static_cast<int>(i);
      const double power = daylight.at(static_cast<float>(nm));
      const Xyz seen = observer(nm);
      colours[i] = rec709({seen.x * power, seen.y * power, seen.z * power});
      for (std::size_t c = 0; c < 3; ++c) white[c] += colours[i][c] = std::max(colours[i][c], 0.);
    }
    double sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      for (std::size_t c = 0; c < 3; ++c) colours[i][c] /= white[c];
      probability[i] = (colours[i][0] + colours[i][1] + colours[i][2]) / 3;
      sums[i] = sum += probability[i];
      for (int c = 0; c < 3; ++c)
        hue[i][c] = static_cast<float>(colours[i][static_cast<std::size_t>(c)] / std::max(probability[i], 1e-30));
    }
  }
};

const Hues& hues() {
  static const Hues made;
  return made;
}

std::size_t index_of(int nm) { return static_cast<std::size_t>(nm - kFirstNm); }

}  // namespace

std::int16_t wavelength_at(double u) {
  const auto& sums = hues().sums;
  const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u * sums.back());
  return static_cast<std::int16_t>(kFirstNm + (found - sums.begin()));
}

std::int16_t wavelength_of(std::uint64_t seed, std::uint64_t iteration) {
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio
  const std::uint64_t place = mix_bits(seed + kGolden) + iteration * kGolden;
  return wavelength_at(static_cast<double>(place >> 11) * 0x1p-53);
}

double wavelength_probability(int nm) { return hues().probability[index_of(nm)]; }

Spectrum hue(int nm) { return nm < 0 ? Spectrum(3, 0, 0) : hues().hue[index_of(nm)]; }

}  // namespace dspm
