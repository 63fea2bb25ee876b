// What a camera records by wavelength. Its red, green and blue are not those of the observer of 1931, so two cameras show some
// dyes and most lamps in other colours.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "dspm/base/colour/spectral_curve.h"

namespace dspm {

class Sensor {
 public:
  /// Takes the responses of red, green and blue to light of each wavelength, in any unit. A matrix makes them Rec. 709: white
  /// daylight stays white, and smooth reflectances get as close to their colours as a matrix can bring them. Throws
  /// std::runtime_error if the responses do not tell colours apart.
  explicit Sensor(const std::array<SpectralCurve, 3>& responses);

  /// Returns what light of that wavelength adds to white daylight in the camera's picture, in Rec. 709. The sum over all
  /// wavelengths is 1.
  const std::array<double, 3>& part_of_white(int nm) const { return parts_[static_cast<std::size_t>(nm - kFirstNm)]; }
  std::span<const std::array<double, 3>> parts_of_white() const { return parts_; }

 private:
  std::array<std::array<double, 3>, kLastNm - kFirstNm + 1> parts_{};
};

/// Measured sensors by pbrt's names; null if nobody has that name.
std::shared_ptr<const Sensor> named_sensor(std::string_view name);

}  // namespace dspm
