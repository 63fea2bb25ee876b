#include "dspm/base/colour/palette.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "dspm/base/colour/interference.h"
#include "dspm/base/colour/sensor.h"
#include "dspm/base/colour/smooth_spectra.h"
#include "dspm/base/colour/spectrum_lanes.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/simd.h"

namespace dspm {
namespace {

constexpr int kCells = SmoothSpectra::kSide - 1;

}  // namespace

struct Palette::Spectral {
  std::array<int, 3> nm;
  std::vector<SpectrumLanes> smooth;  // by SmoothSpectra::index()
  std::array<Rgb, 3> seen;            // of each component
  std::array<Spectrum, 3> primaries;  // shares that red, green and blue have of each component

  Spectral(const std::array<int, 3>& wavelengths, const Sensor* sensor) : nm(wavelengths) {
    const SmoothSpectra& spectra = SmoothSpectra::all();
    const auto at = [&](int r, int g, int b) {
      const SmoothSpectrum& spectrum = spectra.at(r, g, b);
      return Spectrum(spectrum.at(nm[0]), spectrum.at(nm[1]), spectrum.at(nm[2]));
    };
    smooth.reserve(SmoothSpectra::kSide * SmoothSpectra::kSide * SmoothSpectra::kSide);
    for (int r = 0; r <= kCells; ++r)
      for (int g = 0; g <= kCells; ++g)
        for (int b = 0; b <= kCells; ++b) smooth.emplace_back(at(r, g, b));
    for (int k = 0; k < 3; ++k) {
      const int wavelength = nm[static_cast<std::size_t>(k)];
      const std::array<float, 3> shares = spectra.shares(wavelength);
      for (std::size_t c = 0; c < 3; ++c) primaries[c][k] = shares[c];
      const std::array<double, 3> part =
          sensor != nullptr ? sensor->part_of_white(wavelength) : part_of_white(wavelength);
      const double chance = wavelength_probability(wavelength);
      for (int c = 0; c < 3; ++c)
        seen[static_cast<std::size_t>(k)][c] = static_cast<float>(part[static_cast<std::size_t>(c)] / (3 * chance));
    }
  }
};

constinit const Palette Palette::kRgb;

std::shared_ptr<const Palette> Palette::of_iteration(std::uint64_t seed, std::uint64_t iteration,
                                                     const Sensor* sensor) {
  std::array<int, 3> nm;
  for (std::size_t k = 0; k < 3; ++k) {
    const double u = place_among_wavelengths(seed, iteration) + static_cast<double>(k) / 3;
    nm[k] = wavelength_at(u < 1 ? u : u - 1);
  }
  return std::shared_ptr<const Palette>(new Palette(std::make_shared<const Spectral>(nm, sensor)));
}

int Palette::nm(int component) const { return spectral_->nm[static_cast<std::size_t>(component)]; }

/// Scales the colour down to where it is at most 1, and blends the smooth spectra at the corners of the tetrahedron around
/// it: greys lie on an edge of it, and so are blends of greys.
Spectrum Palette::smooth(const Rgb& c, float most) const {
  struct Axis {
    float share;  // between the corner and the next
    std::size_t step;
  };
  if (!(c.r >= 0 && c.g >= 0 && c.b >= 0)) return {c.r, c.g, c.b};  // for whoever looks for such values
  const float scale = std::max(most, max_component(c));
  if (!(scale > 0 && std::isfinite(scale))) return Spectrum(scale > 0 ? scale : 0);
  std::size_t corner = 0;
  std::array<Axis, 3> axes{Axis{0, SmoothSpectra::index(1, 0, 0)}, {0, SmoothSpectra::index(0, 1, 0)}, {0, 1}};
  for (int i = 0; i < 3; ++i) {
    Axis& axis = axes[static_cast<std::size_t>(i)];
    const float place = c[i] / scale * kCells;
    const int below = std::min(static_cast<int>(place), kCells - 1);
    axis.share = place - static_cast<float>(below);
    corner += static_cast<std::size_t>(below) * axis.step;
  }
  const auto sort = [](Axis& a, Axis& b) {
    const bool less = a.share < b.share;
    const Axis high{less ? b.share : a.share, less ? b.step : a.step},
        low{less ? a.share : b.share, less ? a.step : b.step};
    a = high, b = low;
  };
  sort(axes[0], axes[1]), sort(axes[1], axes[2]), sort(axes[0], axes[1]);
  __m128 at = spectral_->smooth[corner].lanes, sum = at;
  for (const Axis& axis : axes) {
    const __m128 next = spectral_->smooth[corner += axis.step].lanes;
    sum = _mm_add_ps(sum, _mm_mul_ps(_mm_set1_ps(axis.share), _mm_sub_ps(next, at)));
    at = next;
  }
  return SpectrumLanes(_mm_mul_ps(sum, _mm_set1_ps(scale))).spectrum();
}

Spectrum Palette::blended(const Rgb& c) const {
  const auto& [red, green, blue] = spectral_->primaries;
  return red * c.r + green * c.g + blue * c.b;
}

Spectrum Palette::at_its(const SpectrumByNm& spectrum) const {
  const auto& nm = spectral_->nm;
  return {spectrum.at(nm[0]), spectrum.at(nm[1]), spectrum.at(nm[2])};
}

Spectrum Palette::interference(float path_nm) const {
  if (is_rgb()) {
    const Rgb colour = dspm::interference(path_nm);
    return {colour.r, colour.g, colour.b};
  }
  const auto at = [&](std::size_t k) {
    const double turns = double{path_nm} / spectral_->nm[k];
    return static_cast<float>(std::cos(2 * std::acos(-1.) * (turns - std::floor(turns))));
  };
  return {at(0), at(1), at(2)};
}

Rgb Palette::matched(const Spectrum& s) const {
  const auto& [first, second, third] = spectral_->seen;
  return first * s[0] + second * s[1] + third * s[2];
}

Rgb Palette::seen(int component) const {
  Spectrum one;
  one[component] = 1;
  return seen(one);
}

}  // namespace dspm
