// Measured materials that nobody has measured: files in RGL's format of a surface of GGX facets.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/measured/bilinear_warp.h"
#include "dspm/materials/microfacet.h"

namespace dspm::test {

struct BsdfTable {
  std::string name;
  std::vector<std::uint64_t> shape;
  std::vector<float> values;
};

inline std::string bsdf_file(const std::vector<BsdfTable>& tables) {
  const auto put = [](std::string& to, auto value) { to.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  std::size_t header = 12 + 2 + 4;
  for (const BsdfTable& table : tables) header += 2 + table.name.size() + 2 + 1 + 8 + 8 * table.shape.size();
  std::string file("tensor_file\0\1\0", 14), data;
  put(file, static_cast<std::uint32_t>(tables.size()));
  for (const BsdfTable& table : tables) {
    constexpr std::uint8_t kFloat = 10;
    put(file, static_cast<std::uint16_t>(table.name.size()));
    file += table.name;
    put(file, static_cast<std::uint16_t>(table.shape.size()));
    put(file, kFloat);
    put(file, static_cast<std::uint64_t>(header + data.size()));
    for (const std::uint64_t extent : table.shape) put(file, extent);
    for (const float value : table.values) put(data, value);
  }
  return file + data;
}

/// GGX of that alpha whose facets reflect `reflectance` by wavelength, from 400 nm to 700 nm, as far as others do not hide
/// them. The luminance is uneven on purpose.
inline std::vector<BsdfTable> ggx_tables(float alpha, const std::vector<float>& reflectance, std::uint64_t side = 96) {
  constexpr std::uint64_t kAngles = 24, kTexels = 32;
  const Ggx facets({alpha, alpha});
  const auto angle = [](float root) { return root * root * kPi / 2; };
  const auto above = [](float theta, float phi = 0) {
    return Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  };
  const auto share = [](std::uint64_t i, std::uint64_t count) {
    return static_cast<float>(i) / static_cast<float>(count - 1);
  };
  const auto sigma = [&](const Vec3& w) {
    const Vec3 clear{w.x, w.y, std::max(w.z, 1e-4f)};
    return clear.z * (1 + facets.lambda(clear));
  };
  BsdfTable phi{"phi_i", {1}, {0}}, theta{"theta_i", {kAngles}, {}}, ndf{"ndf", {2, side}, {}},
      projected{"sigma", {2, side}, {}}, visible{"vndf", {1, kAngles, side, side}, {}},
      luminance{"luminance", {1, kAngles, 3, 2}, {}},
      spectra{"spectra", {1, kAngles, reflectance.size(), kTexels, kTexels}, {}},
      wavelengths{"wavelengths", {reflectance.size()}, {}};
  for (std::uint64_t i = 0; i < reflectance.size(); ++i)
    wavelengths.values.push_back(400 + 300 * share(i, reflectance.size()));
  for (int row = 0; row < 2; ++row)
    for (std::uint64_t x = 0; x < side; ++x) {
      ndf.values.push_back(facets.density(above(angle(share(x, side)))));
      projected.values.push_back(sigma(above(angle(share(x, side)))));
    }
  for (std::uint64_t k = 0; k < kAngles; ++k) {
    theta.values.push_back(share(k, kAngles) * kPi / 2 * 0.99f);
    const Vec3 wo = above(theta.values.back());
    for (std::uint64_t y = 0; y < side; ++y)
      for (std::uint64_t x = 0; x < side; ++x) {
        const float root = share(x, side), around = (2 * share(y, side) - 1) * kPi;
        const Vec3 m = above(angle(root), around);
        visible.values.push_back(facets.density(m) * std::max(0.f, dot(wo, m)) / sigma(wo) * root *
                                 std::sin(angle(root)));
      }
    for (const float each : {1.f, 2.f, 1.5f, 1.f, 0.5f, 2.f}) luminance.values.push_back(each);
    const std::size_t cells = side * side;
    const BilinearWarp warp(std::span(visible.values).subspan(k * cells, cells), static_cast<int>(side),
                            static_cast<int>(side));
    std::vector<float> seen;  // G2 / G1
    for (std::uint64_t texel = 0; texel < kTexels * kTexels; ++texel) {
      const Vec2 p = warp.sample({share(texel % kTexels, kTexels), share(texel / kTexels, kTexels)}, {}).p;
      const Vec3 wi = reflect(wo, above(angle(p.x), (2 * p.y - 1) * kPi));
      seen.push_back(wi.z > 0 ? facets.visible_after(wo, wi) : 0);
    }
    for (const float each : reflectance)
      for (const float share_seen : seen) spectra.values.push_back(each * share_seen);
  }
  return {phi, theta, ndf, projected, visible, luminance, spectra, wavelengths};
}

}  // namespace dspm::test
