// The pixel filters, all separable:
//   PixelFilter "gaussian" "float xradius" 1.5 "float yradius" 1.5 "float sigma" 0.5
//   PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
//   PixelFilter "triangle" "float xradius" 2 "float yradius" 2
// Radii and sigma are in pixels. The gaussian is lowered so that it ends in 0 at its radius, as in pbrt. Filters with
// negative lobes (mitchell, sinc) cannot be importance-sampled without negative weights and are not supported.
// Reference: Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., section 8.8.
#include "dspm/film/pixel_filter.h"

#include <algorithm>
#include <cmath>

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

/// 256 steps over at most 6 sigma per side: the density is off by less than 3e-4 of its maximum.
FilterProfile gaussian_profile(float radius, float sigma) {
  constexpr int kSteps = 256;
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

}  // namespace

PluginTable<Plugin<MakePixelFilter>>& pixel_filter_plugins() {
  static PluginTable<Plugin<MakePixelFilter>> table(
      "filter",
      {
          {"gaussian", "a gaussian that ends in 0 at its radius", make_gaussian},
          {"box", "every place within the radius counts equally", make_box},
          {"triangle", "falls linearly to 0 at its radius", make_triangle},
      },
      {"mitchell", "sinc"});
  return table;
}

}  // namespace dspm
