#include "dspm/materials/measured/measured_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/sampled_colours.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/microfacet.h"

namespace dspm {
namespace {

using Tables = std::map<std::string, Tensor>;

[[noreturn]] void fail(const std::string& cause) { throw std::runtime_error(cause); }

/// Returns a table with that many dimensions, finite and not negative where it must be.
const Tensor& table(const Tables& tables, std::string_view name, std::size_t dimensions, bool positive = true) {
  const auto found = tables.find(std::string(name));
  if (found == tables.end()) fail(fmt::format("the file has no table \"{}\"", name));
  const Tensor& tensor = found->second;
  if (tensor.shape.size() != dimensions || tensor.values.empty())
    fail(fmt::format("table \"{}\" does not have {} dimensions", name, dimensions));
  for (const float v : tensor.values)
    if (!std::isfinite(v) || (positive && v < 0)) fail(fmt::format("table \"{}\" holds the number {}", name, v));
  return tensor;
}

std::vector<float> ascending(const Tables& tables, const std::string& name) {
  const Tensor& tensor = table(tables, name, 1, false);
  if (std::adjacent_find(tensor.values.begin(), tensor.values.end(), std::greater_equal<>()) != tensor.values.end())
    fail(fmt::format("table \"{}\" does not ascend", name));
  return tensor.values;
}

GridParameters parameters_of(const Tables& tables) {
  return {ascending(tables, "phi_i"), ascending(tables, "theta_i")};
}

bool is_isotropic(const Tables& tables) {
  const std::vector<float> phi = ascending(tables, "phi_i");
  if (phi.size() <= 2) return true;
  if (std::abs(phi.back() - phi.front() - 2 * kPi) > 0.1f * kPi)
    fail("azimuths that cover a part of the circle are not supported");
  return false;
}

/// Returns one grid for each pair of parameters; the squares' sides are the last two dimensions. It is 0 nowhere, so
/// that all that is reflected is sampled.
BilinearWarp warp_of(const Tables& tables, const std::string& name, const GridParameters& parameters) {
  constexpr double kLeast = 1e-6;  // of the mean
  Tensor tensor = table(tables, name, 4);
  const std::size_t height = tensor.shape[2], width = tensor.shape[3];
  if (tensor.shape[0] * tensor.shape[1] != parameters.count() || width < 2 || height < 2)
    fail(fmt::format("table \"{}\" has another size than its angles", name));
  for (std::size_t grid = 0; grid < parameters.count(); ++grid) {
    const auto begin = tensor.values.begin() + static_cast<std::ptrdiff_t>(grid * width * height);
    const double sum = std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(width * height), 0.);
    if (!(sum > 0) || !std::isfinite(static_cast<float>(sum))) fail(fmt::format("table \"{}\" has no integral", name));
    const auto least = static_cast<float>(kLeast * sum / static_cast<double>(width * height));
    for (auto v = begin; v != begin + static_cast<std::ptrdiff_t>(width * height); ++v) *v = std::max(*v, least);
  }
  return {tensor.values, static_cast<int>(width), static_cast<int>(height)};
}

// The tables' coordinates: roots of angles to the normal, so that nodes are densest around it; and turns.
float root_of_angle(const Vec3& w) { return std::sqrt(rounded::atan2(rounded::hypot(w.x, w.y), w.z) * (2 / kPi)); }
float azimuth(const Vec3& w) { return rounded::atan2(w.y, w.x); }
float turn_of_azimuth(float phi) { return phi / (2 * kPi) + 0.5f; }

constexpr float kLeastJacobian = 1e-6f;

/// Returns solid angle over area of the square, at a facet normal.
float solid_angle(float root, float sine) { return std::max(2 * kPi * kPi * root * sine, kLeastJacobian); }

}  // namespace

struct MeasuredFile::Facet {
  Facet(const MeasuredFile& file, const Vec3& wo, const Vec3& wi)
      : m(normalize(wo + wi)),
        phi_o(azimuth(wo)),
        o{root_of_angle(wo), turn_of_azimuth(phi_o)},
        at{root_of_angle(m), turn_of_azimuth(file.turn(azimuth(m), phi_o))},
        mix(file.parameters_.at(phi_o, rounded::acos(std::min(wo.z, 1.f)))) {
    at.y -= std::floor(at.y);
  }
  Vec3 m;
  float phi_o;
  Vec2 o, at;
  GridMix mix;
};

MeasuredFile::MeasuredFile(const Tables& tables)
    : parameters_(parameters_of(tables)),
      is_isotropic_(dspm::is_isotropic(tables)),
      facets_(grid_of(table(tables, "ndf", 2))),
      projected_(grid_of(table(tables, "sigma", 2))),
      visible_(warp_of(tables, "vndf", parameters_)),
      luminance_(warp_of(tables, "luminance", parameters_)),
      alpha_(measure_alpha()) {
  read_reflectance(tables);
}

MeasuredFile::Grid MeasuredFile::grid_of(const Tensor& table) {
  if (table.shape[0] < 2 || table.shape[1] < 2) fail("a table has fewer than 2 x 2 values");
  return {static_cast<int>(table.shape[1]), static_cast<int>(table.shape[0]), table.values};
}

float MeasuredFile::Grid::at(const Vec2& p) const {
  return GridPlace(p, width, height).interpolate([&](int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  });
}

void MeasuredFile::read_reflectance(const Tables& tables) {
  const bool is_rgb = tables.contains("rgb");
  const Tensor& tensor = table(tables, is_rgb ? "rgb" : "spectra", 5, false);
  const std::vector<float> nm = is_rgb ? std::vector<float>() : ascending(tables, "wavelengths");
  const std::size_t colours = is_rgb ? 3 : nm.size(), side = tensor.shape[3];
  if (tensor.shape[0] * tensor.shape[1] != parameters_.count() || tensor.shape[2] != colours ||
      tensor.shape[4] != side || side < 2)
    fail("the table of reflected light has another size than its angles and wavelengths");
  side_ = static_cast<int>(side), reflectance_.resize(parameters_.count() * side * side);
  const SampledColours of_spectra(nm);
  if (!is_rgb) spectra_ = SampledSpectra(nm, reflectance_.size());
  std::vector<float> values(colours);
  for (std::size_t i = 0; i < reflectance_.size(); ++i) {
    const std::size_t grid = i / (side * side), texel = i % (side * side);
    for (std::size_t c = 0; c < colours; ++c)
      values[c] = std::max(0.f, tensor.values[(grid * colours + c) * side * side + texel]);
    reflectance_[i] = is_rgb ? Rgb(values[0], values[1], values[2]) : of_spectra.of(values);
    if (!is_rgb) spectra_.set(i, values);
  }
}

/// Returns the alpha of GGX with the same peak, which is 1 / (pi alpha^2) if the integral of D cos is 1.
float MeasuredFile::measure_alpha() const {
  const auto width = static_cast<std::size_t>(facets_.width), height = static_cast<std::size_t>(facets_.height);
  std::vector<double> mean(width);  // over the azimuths, which lie evenly
  for (std::size_t i = 0; i < facets_.values.size(); ++i) {
    const bool is_at_end = i < width || i >= (height - 1) * width;
    mean[i % width] += double{facets_.values[i]} * (is_at_end ? 0.5 : 1) / static_cast<double>(height - 1);
  }
  constexpr int kSteps = 512;
  double integral = 0;
  for (int step = 0; step < kSteps; ++step) {
    const float x = (static_cast<float>(step) + 0.5f) / kSteps, angle = x * x * kPi / 2;
    const GridPlace at({x, 0}, facets_.width, facets_.height);
    const auto column = static_cast<std::size_t>(at.x);
    integral += std::lerp(mean[column], mean[column + 1], double{at.tx}) *
                double{rounded::cos(angle) * solid_angle(x, rounded::sin(angle))} / kSteps;
  }
  const double peak = *std::max_element(facets_.values.begin(), facets_.values.end());
  const double alpha = peak > 0 ? std::sqrt(integral / (peak * std::acos(-1.))) : 1;
  return std::clamp(static_cast<float>(alpha), Ggx::kSmoothest, 1.f);
}

Spectrum MeasuredFile::reflectance(const Vec2& p, const GridMix& mix, const Palette& palette) const {
  const auto side = static_cast<std::size_t>(side_);
  const GridPlace at(p, side_, side_);
  const auto interpolated = [&](auto sum, const auto& value) {
    for (std::size_t k = 0; k < 4; ++k)
      if (mix.weight[k] != 0)
        sum += mix.weight[k] * at.interpolate([&](int x, int y) {
          return value((mix.grid[k] * side + static_cast<std::size_t>(y)) * side + static_cast<std::size_t>(x));
        });
    return sum;
  };
  if (!palette.is_rgb() && !spectra_.empty())
    return interpolated(Spectrum(), [&](std::size_t i) { return spectra_.at(i, palette); });
  return palette.carried(interpolated(Rgb(), [&](std::size_t i) { return reflectance_[i]; }));
}

Spectrum MeasuredFile::f(const Vec3& wo, const Vec3& wi, const Palette& palette) const {
  const Facet facet(*this, wo, wi);
  const float sigma = projected_.at(facet.o);
  if (!(sigma > 0)) return {};
  const BilinearWarp::Point warped = visible_.invert(facet.at, facet.mix);
  return reflectance(warped.p, facet.mix, palette) * (facets_.at(facet.at) / (4 * sigma * wi.z));
}

float MeasuredFile::density(const Vec3& wo, const Vec3& wi) const {
  const Facet facet(*this, wo, wi);
  const BilinearWarp::Point warped = visible_.invert(facet.at, facet.mix);
  const float sine = rounded::hypot(facet.m.x, facet.m.y);
  return luminance_.density(warped.p, facet.mix) * warped.density /
         (solid_angle(facet.at.x, sine) * 4 * std::max(dot(wo, facet.m), 1e-9f));
}

Vec3 MeasuredFile::sample(const Vec3& wo, const Vec2& u) const {
  const float phi_o = azimuth(wo);
  const GridMix mix = parameters_.at(phi_o, rounded::acos(std::min(wo.z, 1.f)));
  const Vec2 at = visible_.sample(luminance_.sample(u, mix).p, mix).p;
  const float angle = at.x * at.x * kPi / 2, phi = (2 * at.y - 1) * kPi + (is_isotropic_ ? phi_o : 0);
  const Vec3 m{rounded::sin(angle) * rounded::cos(phi), rounded::sin(angle) * rounded::sin(phi), rounded::cos(angle)};
  return normalize(m * (2 * dot(wo, m)) - wo);
}

}  // namespace dspm
