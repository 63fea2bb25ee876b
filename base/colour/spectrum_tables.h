// The measured data that spectrum.h needs: the observer, fluorescent lamps, metals and sensors. Everything else has a formula.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace dspm {

/// CIE 1931 2-degree standard observer, 360 to 830 nm in steps of 5 nm.
inline constexpr int kObserverSamples = 95;
extern const std::array<float, kObserverSamples> kObserverX, kObserverY, kObserverZ;

/// Components of daylight S0, S1, S2, 360 to 830 nm in steps of 10 nm.
inline constexpr int kDaylightSamples = 48;
extern const std::array<float, kDaylightSamples> kDaylightS0, kDaylightS1, kDaylightS2;

/// CIE illuminants F1 to F12, 380 to 780 nm in steps of 5 nm, in relative units.
inline constexpr int kFluorescentSamples = 81;
extern const std::array<std::array<float, kFluorescentSamples>, 12> kFluorescent;

/// An optical constant over wavelength in nm, linear between samples.
struct NamedTable {
  std::string_view name;  // "metal-Cu-k"
  std::span<const float> nm, values;
};
std::span<const NamedTable> metal_tables();

/// A camera's responses of red, green and blue, 380 to 780 nm in steps of 5 nm.
inline constexpr int kSensorSamples = 81;
struct SensorTable {
  std::string_view name;  // "canon_eos_5d_mkii"
  std::span<const std::array<float, 3>, kSensorSamples> responses;
};
std::span<const SensorTable> sensor_tables();

}  // namespace dspm
