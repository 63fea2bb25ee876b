// The pixel filters, all separable:
//   PixelFilter "gaussian" "float xradius" 1.5 "float yradius" 1.5 "float sigma" 0.5
//   PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
//   PixelFilter "triangle" "float xradius" 2 "float yradius" 2
//   PixelFilter "mitchell" "float xradius" 2 "float yradius" 2 "float B" 0.333 "float C" 0.333
//   PixelFilter "sinc" "float xradius" 4 "float yradius" 4 "float tau" 3
// Radii and sigma are in pixels. The gaussian is lowered so that it ends in 0 at its radius, as in pbrt. The negative
// lobes of mitchell and sinc would need negative weights: they are left out, so pictures are a little softer than
// pbrt's. Reference: Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., section 8.8.
#include "dspm/image/film/pixel_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dspm {

FilterProfile::FilterProfile(float radius, std::vector<float> weights)
    : radius_(radius), weights_(std::move(weights)), cumulative_(weights_.size()) {
  double mass = 0;
  std::vector<double> below(weights_.size());
  for (std::size_t i = 1; i < weights_.size(); ++i) below[i] = mass += 0.5 * (weights_[i - 1] + weights_[i]);
  for (std::size_t i = 0; i < weights_.size(); ++i) cumulative_[i] = static_cast<float>(below[i] / mass);
  const float scale = static_cast<float>(1 / mass);
  for (float& weight : weights_) weight *= scale;
}

float FilterProfile::sample(float u) const {
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
  const auto i = static_cast<std::size_t>(above - cumulative_.begin()) - 1;

  // Between two nodes the mass up to t in [0, 1] is a t + (b - a) t^2 / 2; this form of the root has no cancellation.
  const float a = weights_[i], b = weights_[i + 1], mass = std::max(u - cumulative_[i], 0.f);
  const float root = a + std::sqrt(std::max(a * a + 2 * (b - a) * mass, 0.f));
  const float t = root > 0 ? std::min(2 * mass / root, 1.f) : 0.f;
  const float position = (static_cast<float>(i) + t) / static_cast<float>(weights_.size() - 1);
  return radius_ * (2 * position - 1);
}

float FilterProfile::density(float offset) const {
  if (!(std::abs(offset) <= radius_)) return 0;
  const auto steps = static_cast<float>(weights_.size() - 1);
  const float position = (offset / radius_ + 1) / 2 * steps;
  const auto i = std::min(static_cast<std::size_t>(position), weights_.size() - 2);
  const float t = position - static_cast<float>(i);
  return (weights_[i] * (1 - t) + weights_[i + 1] * t) * steps / (2 * radius_);
}

namespace {

float read_radius(ParamReader& reader, const char* name, float fallback) {
  const float radius = reader.number(name, fallback, "pixels", "half the filter's extent");
  if (radius > 0) return radius;
  reader.error(name, "a filter's radius must be above 0");
  return fallback;
}

std::unique_ptr<PixelFilter> make_box(ParamReader& reader) {
  const float x = read_radius(reader, "xradius", 0.5f), y = read_radius(reader, "yradius", 0.5f);
  reader.finish();
  return std::make_unique<PixelFilter>(FilterProfile(x, {1, 1}), FilterProfile(y, {1, 1}));
}

std::unique_ptr<PixelFilter> make_triangle(ParamReader& reader) {
  const float x = read_radius(reader, "xradius", 2), y = read_radius(reader, "yradius", 2);
  reader.finish();
  return std::make_unique<PixelFilter>(FilterProfile(x, {0, 1, 0}), FilterProfile(y, {0, 1, 0}));
}

constexpr int kSteps = 256;

/// 256 steps over at most 6 sigma per side: the density is off by less than 3e-4 of its maximum.
FilterProfile gaussian_profile(float radius, float sigma) {
  const double reach = std::min(radius, 6 * sigma);
  const auto gauss = [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
  std::vector<float> weights;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = reach * (2.0 * i / kSteps - 1);
    weights.push_back(static_cast<float>(std::max(gauss(x) - gauss(radius), 0.0)));
  }
  return FilterProfile(static_cast<float>(reach), std::move(weights));
}

std::unique_ptr<PixelFilter> make_gaussian(ParamReader& reader) {
  const float x = read_radius(reader, "xradius", 1.5f), y = read_radius(reader, "yradius", 1.5f);
  float sigma = reader.number("sigma", 0.5f, "pixels", "standard deviation of the gaussian");
  if (!(sigma > 0)) reader.error("sigma", "sigma must be above 0"), sigma = 0.5f;
  reader.finish();
  return std::make_unique<PixelFilter>(gaussian_profile(x, sigma), gaussian_profile(y, sigma));
}

/// The positive part of a function of the offset.
template <class Fn>
FilterProfile positive_profile(float radius, const Fn& function) {
  std::vector<float> weights;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = static_cast<double>(radius) * (2.0 * i / kSteps - 1);
    weights.push_back(static_cast<float>(std::max(function(x), 0.0)));
  }
  return FilterProfile(radius, std::move(weights));
}

/// Evaluates the filter at x in units of half the radius, not normalised. [Mitchell, Netravali 1988]
double mitchell(double x, double b, double c) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x >= 1) return (-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c);
  return (12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b);
}

double sinc(double x) { return std::abs(x) < 1e-5 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

void note_lobes(ParamReader& reader) {
  reader.diagnostics().note(reader.where(), fmt::format("{}: its negative lobes are left out", reader.subject()));
}

std::unique_ptr<PixelFilter> make_mitchell(ParamReader& reader) {
  const float x = read_radius(reader, "xradius", 2), y = read_radius(reader, "yradius", 2);
  const auto b = static_cast<double>(reader.number("B", 1 / 3.f, "", "blur")),
             c = static_cast<double>(reader.number("C", 1 / 3.f, "", "ringing"));
  if (!(b >= 0 && b < 3)) reader.error("B", "\"B\" must be at least 0 and less than 3");
  if (!(c >= 0)) reader.error("C", "\"C\" must not be negative");
  reader.finish();
  if (c > 0) note_lobes(reader);
  const auto profile = [&](float radius) {
    return positive_profile(radius, [&](double at) { return mitchell(2 * at / static_cast<double>(radius), b, c); });
  };
  return std::make_unique<PixelFilter>(profile(x), profile(y));
}

std::unique_ptr<PixelFilter> make_sinc(ParamReader& reader) {
  const float x = read_radius(reader, "xradius", 4), y = read_radius(reader, "yradius", 4);
  const auto tau = static_cast<double>(reader.number("tau", 3, "", "cycles of the sinc within the window"));
  if (!(tau > 0)) reader.error("tau", "\"tau\" must be above 0");
  reader.finish();
  note_lobes(reader);
  // Windowed by a wider sinc. [Duchon 1979, Lanczos filtering in one and two dimensions]
  const auto profile = [&](float radius) {
    return positive_profile(radius, [&](double at) { return sinc(at) * sinc(at / tau); });
  };
  return std::make_unique<PixelFilter>(profile(x), profile(y));
}

}  // namespace

PluginTable<Plugin<MakePixelFilter>>& pixel_filter_plugins() {
  static PluginTable<Plugin<MakePixelFilter>> table(
      "filter", {
                    {"gaussian", "a gaussian that ends in 0 at its radius", make_gaussian},
                    {"box", "every place within the radius counts equally", make_box},
                    {"triangle", "falls linearly to 0 at its radius", make_triangle},
                    {"mitchell", "pbrt's compromise of blur and ringing, without its negative lobes", make_mitchell},
                    {"sinc", "the positive lobes of a windowed sinc", make_sinc},
                });
  return table;
}

}  // namespace dspm
