// Colours as smooth spectra: of all the reflectances that look like a colour, one that rises and falls slowly. It is a
// sigmoid of a parabola of the wavelength. [Jakob and Hanika 2019, A Low-Dimensional Function Space for Efficient Spectral
// Upsampling]
#pragma once

#include <array>
#include <cstddef>

#include "dspm/base/colour/rgb.h"

namespace dspm {

/// A reflectance between 0 and 1 at each wavelength.
class SmoothSpectrum {
 public:
  SmoothSpectrum() = default;
  /// Takes a colour in 0..1, under daylight, and begins its search with a spectrum that is not far.
  SmoothSpectrum(const Rgb& colour, const SmoothSpectrum& begin);

  float at(int nm) const;

 private:
  bool is_constant_ = true;
  float constant_ = 0;                           // else
  std::array<double, 3> coefficients_{0, 0, 0};  // of the parabola, over 360 to 830 nm as 0 to 1, the square first
};

/// The spectra of a grid of colours. Those between are blended linearly: as colours are linear in spectra, these still
/// have their colours.
class SmoothSpectra {
 public:
  static constexpr int kSide = 17;  // 0, 1/16, ... 1

  static const SmoothSpectra& all();
  const SmoothSpectrum& at(int r, int g, int b) const { return grid_[index(r, g, b)]; }
  /// The shares that red, green and blue have of a wavelength. They add up to 1.
  std::array<float, 3> shares(int nm) const;
  static std::size_t index(int r, int g, int b) { return static_cast<std::size_t>((r * kSide + g) * kSide + b); }

 private:
  SmoothSpectra();
  std::array<SmoothSpectrum, kSide * kSide * kSide> grid_;
};

}  // namespace dspm
