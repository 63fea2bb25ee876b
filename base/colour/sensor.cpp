#include "dspm/base/colour/sensor.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "dspm/base/colour/smooth_spectra.h"
#include "dspm/base/colour/spectrum_tables.h"
#include "dspm/base/colour/wavelength.h"

namespace dspm {
namespace {

using Three = std::array<double, 3>;
using ByNm = std::array<Three, kLastNm - kFirstNm + 1>;

/// Returns the responses to daylight, white being 1.
ByNm white_balanced(const std::array<SpectralCurve, 3>& responses) {
  const SpectralCurve daylight = *named_spectrum("stdillum-D65");
  ByNm parts;
  Three white{};
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float nm = static_cast<float>(i) + kFirstNm;
      white[c] += parts[i][c] = double{responses[c].at(nm)} * double{daylight.at(nm)};
    }
  if (*std::min_element(white.begin(), white.end()) <= 0)
    throw std::runtime_error("one of its three responses to daylight is not above 0");
  for (Three& part : parts)
    for (std::size_t c = 0; c < 3; ++c) part[c] /= white[c];
  return parts;
}

/// A smooth reflectance: its colour, and what the sensor records of it.
struct Sample {
  Three colour{}, recorded{};
};

std::vector<Sample> samples_of(const ByNm& parts) {
  constexpr std::array kPlaces{2, 6, 10, 14};  // among the sides of SmoothSpectra
  std::vector<Sample> samples;
  for (const int r : kPlaces)
    for (const int g : kPlaces)
      for (const int b : kPlaces) {
        const SmoothSpectrum& reflectance = SmoothSpectra::all().at(r, g, b);
        Sample& sample = samples.emplace_back();
        for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
          const double value = double{reflectance.at(nm)};
          const Three seen = part_of_white(nm);
          for (std::size_t c = 0; c < 3; ++c) {
            sample.colour[c] += seen[c] * value;
            sample.recorded[c] += parts[static_cast<std::size_t>(nm - kFirstNm)][c] * value;
          }
        }
      }
  return samples;
}

/// Returns the row of the matrix for a component, by least squares. Its sum is 1, so white stays white.
Three row_of(std::size_t c, std::span<const Sample> samples) {
  double aa = 0, ab = 0, bb = 0, ad = 0, bd = 0;
  for (const auto& [colour, recorded] : samples) {
    const double a = recorded[0] - recorded[2], b = recorded[1] - recorded[2], d = colour[c] - recorded[2];
    aa += a * a, ab += a * b, bb += b * b, ad += a * d, bd += b * d;
  }
  constexpr double kAlike = 1e-6;
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > kAlike * aa * bb)) throw std::runtime_error("its responses are too alike to tell colours apart");
  const double first = (ad * bb - bd * ab) / determinant, second = (bd * aa - ad * ab) / determinant;
  return {first, second, 1 - first - second};
}

}  // namespace

Sensor::Sensor(const std::array<SpectralCurve, 3>& responses) {
  const ByNm parts = white_balanced(responses);
  const std::vector<Sample> samples = samples_of(parts);
  for (std::size_t c = 0; c < 3; ++c) {
    const Three row = row_of(c, samples);
    for (std::size_t i = 0; i < parts.size(); ++i)
      parts_[i][c] = row[0] * parts[i][0] + row[1] * parts[i][1] + row[2] * parts[i][2];
  }
}

std::shared_ptr<const Sensor> named_sensor(std::string_view name) {
  for (const SensorTable& table : sensor_tables()) {
    if (table.name != name) continue;
    std::array<SpectralCurve, 3> responses;
    for (std::size_t i = 0; i < table.responses.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        responses[c].nm.push_back(380 + 5 * static_cast<float>(i));
        responses[c].values.push_back(table.responses[i][c]);
      }
    return std::make_shared<const Sensor>(responses);
  }
  return nullptr;
}

}  // namespace dspm
