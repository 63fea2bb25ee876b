#include "dspm/base/colour/wavelength.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "dspm/base/colour/observer.h"
#include "dspm/base/math/rng.h"

namespace dspm {
namespace {

constexpr std::size_t kCount = kLastNm - kFirstNm + 1;

struct Hues {
  std::array<std::array<double, 3>, kCount> part_of_white;
  std::array<Spectrum, kCount> hue;
  std::array<double, kCount> probability;
  std::array<double, kCount> sums;  // of probabilities, up to and with each

  Hues() {
    const SpectralCurve daylight = *named_spectrum("stdillum-D65");
    std::array<std::array<double, 3>, kCount> colours;
    std::array<double, 3> white{}, clamped_white{};
    for (std::size_t i = 0; i < kCount; ++i) {
      const int nm = kFirstNm + static_cast<int>(i);
      const double power = daylight.at(static_cast<float>(nm));
      const Xyz seen = observer(nm);
      colours[i] = rec709({seen.x * power, seen.y * power, seen.z * power});
      for (std::size_t c = 0; c < 3; ++c) white[c] += colours[i][c], clamped_white[c] += std::max(colours[i][c], 0.);
    }
    for (std::size_t i = 0; i < kCount; ++i)
      for (std::size_t c = 0; c < 3; ++c) part_of_white[i][c] = colours[i][c] / white[c];
    set_probabilities();
    for (std::size_t i = 0; i < kCount; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        hue[i][static_cast<int>(c)] =
            static_cast<float>(std::max(colours[i][c], 0.) / clamped_white[c] / probability[i]);
  }

  /// What a wavelength adds to the three colours or takes from them, blurred. So what it adds, over its probability, has no
  /// edges and fades towards both ends, and a few wavelengths that are as far apart as can be say almost all.
  void set_probabilities() {
    constexpr double kBlurNm = 30;
    for (std::size_t i = 0; i < kCount; ++i) {
      probability[i] = 0;
      for (std::size_t k = 0; k < kCount; ++k) {
        const auto& part = part_of_white[k];
        const double away = (static_cast<double>(i) - static_cast<double>(k)) / kBlurNm;
        probability[i] += (std::abs(part[0]) + std::abs(part[1]) + std::abs(part[2])) * std::exp(-away * away / 2);
      }
    }
    const double all = std::accumulate(probability.begin(), probability.end(), 0.);
    double sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) sums[i] = sum += probability[i] /= all;
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

double place_among_wavelengths(std::uint64_t seed, std::uint64_t iteration) {
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio
  constexpr int kBlock = 5;                               // bits
  std::uint64_t halves = 0;  // the block's iterations halve the gaps between those before [van der Corput 1935]
  for (int bit = 0; bit < kBlock; ++bit) halves |= (iteration >> bit & 1) << (63 - bit);
  const std::uint64_t place = mix_bits(seed + kGolden) + halves + (iteration >> kBlock) * kGolden;
  return static_cast<double>(place >> 11) * 0x1p-53;
}

std::int16_t wavelength_of(std::uint64_t seed, std::uint64_t iteration) {
  return wavelength_at(place_among_wavelengths(seed, iteration));
}

std::array<double, 3> part_of_white(int nm) { return hues().part_of_white[index_of(nm)]; }

double wavelength_probability(int nm) { return hues().probability[index_of(nm)]; }

Spectrum hue(int nm) { return nm < 0 ? Spectrum(3, 0, 0) : hues().hue[index_of(nm)]; }

}  // namespace dspm
