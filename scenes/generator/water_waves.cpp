#include "scenes/generator/water_waves.h"

#include <cmath>
#include <utility>

namespace dspm {
namespace {

constexpr int kModes = 128;  // along a side
constexpr double kPiD = 3.14159265358979323846;
constexpr double kGravity = 9.81, kTension = 7.28e-5;  // m/s^2; surface tension over density, m^3/s^2

/// cos(m pi x / side) and its derivative for all coordinates and modes.
struct Cosines {
  std::vector<double> value, slope;
};

Cosines cosines(const std::vector<float>& coordinates, double side) {
  Cosines result;
  for (const float x : coordinates)
    for (int m = 0; m < kModes; ++m) {
      const double k = m * kPiD / side, phase = k * static_cast<double>(x);
      result.value.push_back(std::cos(phase));
      result.slope.push_back(-k * std::sin(phase));
    }
  return result;
}

double dot(const double* a, const double* b) {
  double sum = 0;
  for (int m = 0; m < kModes; ++m) sum += a[m] * b[m];
  return sum;
}

}  // namespace

WaterWaves::WaterWaves(float side, float depth, float damping, std::vector<Blow> blows)
    : side_(side), depth_(depth), damping_(damping), blows_(std::move(blows)) {}

std::vector<double> WaterWaves::amplitudes(float time) const {
  std::vector<double> sums(kModes * kModes, 0.);
  for (const Blow& blow : blows_) {
    const double t = static_cast<double>(time) - static_cast<double>(blow.time);
    if (t <= 0) continue;
    const double x = static_cast<double>(blow.place.x), z = static_cast<double>(blow.place.y);
    for (int n = 0; n < kModes; ++n)
      for (int m = 0; m < kModes; ++m) {
        if (m + n == 0) continue;  // a blow takes no water away
        const double km = m * kPiD / side_, kn = n * kPiD / side_, k = std::hypot(km, kn);
        // The blow's Fourier transform, pi R^2 s exp(-s) with s = k^2 R^2 / 4, over the norm of the cosines.
        const double s = 0.25 * k * k * static_cast<double>(blow.radius) * static_cast<double>(blow.radius);
        const double norm = side_ * side_ / ((m > 0 ? 2 : 1) * (n > 0 ? 2 : 1));
        const double strength = -static_cast<double>(blow.velocity) * kPiD * static_cast<double>(blow.radius) *
                                static_cast<double>(blow.radius) * s * std::exp(-s) * std::cos(km * x) *
                                std::cos(kn * z) / norm;
        const double omega = std::sqrt((kGravity * k + kTension * k * k * k) * std::tanh(k * depth_));
        sums[static_cast<std::size_t>(n * kModes + m)] +=
            strength * std::exp(-damping_ * k * k * t) * std::sin(omega * t) / omega;
      }
  }
  return sums;
}

std::vector<WaterWaves::Point> WaterWaves::surface(const std::vector<float>& xs, const std::vector<float>& zs,
                                                   float time) const {
  const std::vector<double> a = amplitudes(time);
  const Cosines along_x = cosines(xs, side_), along_z = cosines(zs, side_);
  std::vector<Point> points(xs.size() * zs.size());
  // First over the modes along x, for every mode along z; then over those.
  std::vector<double> value(kModes), slope(kModes);
  for (std::size_t i = 0; i < xs.size(); ++i) {
    for (std::size_t n = 0; n < kModes; ++n) {
      value[n] = dot(&a[n * kModes], &along_x.value[i * kModes]);
      slope[n] = dot(&a[n * kModes], &along_x.slope[i * kModes]);
    }
    for (std::size_t j = 0; j < zs.size(); ++j) {
      const double* cos_z = &along_z.value[j * kModes];
      points[j * xs.size() + i] = {static_cast<float>(dot(value.data(), cos_z)),
                                   {static_cast<float>(dot(slope.data(), cos_z)),
                                    static_cast<float>(dot(value.data(), &along_z.slope[j * kModes]))}};
    }
  }
  return points;
}

}  // namespace dspm
