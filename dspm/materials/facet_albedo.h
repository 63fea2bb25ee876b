// Directional albedos of GGX facets, as numbers for tables, and tables that are made once for each index of refraction.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include "dspm/materials/fresnel.h"
#include "dspm/materials/microfacet.h"
#include "dspm/math/vec.h"

namespace dspm {

/// A direction in the plane y = 0.
inline Vec3 direction_of_cosine(float cos) { return {std::sqrt(std::max(0.f, 1 - cos * cos)), 0, cos}; }

/// The mean of fn(facet normal) over the facets visible from o, which lies in the plane y = 0: a midpoint rule, closer at
/// the facets that send light down, half around the plane. Below 0.1% off from outside, 1% from inside at alpha = 1.
template <class Fn>
float mean_over_facets(const Ggx& facets, const Vec3& o, Fn&& fn) {
  constexpr int kAround = 12, kDown = 32;
  double sum = 0;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kDown; ++j) {
      const float u = (static_cast<float>(i) + 0.5f) / (2 * kAround), w = 1 - (static_cast<float>(j) + 0.5f) / kDown;
      sum += static_cast<double>(2 * w * fn(facets.sample_visible(o, u, 1 - w * w)));
    }
  return static_cast<float>(sum / (kAround * kDown));
}

/// The share of light that facets reflect and that then escapes, if a facet reflects fresnel(cos) of it.
template <class Fresnel>
float reflected_by_facets(float cos, float alpha, Fresnel&& fresnel) {
  const Vec3 o = direction_of_cosine(cos);
  const Ggx facets({alpha, alpha});
  return mean_over_facets(facets, o, [&](const Vec3& m) {
    const Vec3 i = reflect(o, m);
    return i.z > 0 ? fresnel(dot(o, m)) * facets.visible_after(o, i) : 0.f;
  });
}
inline float reflected_by_boundary(float cos, float alpha, float eta) {
  return reflected_by_facets(cos, alpha, [&](float c) { return fresnel_dielectric(c, eta); });
}

/// What make(key) gives, made once and kept; for many threads. A table takes kilobytes and a fifteenth of a second, and
/// the looks of long animations are made several times.
template <class T>
class MadeOnce {
 public:
  template <class Make>
  std::shared_ptr<const T> of(float key, Make&& make) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const T>& object = made_[key];
    if (!object) object = std::make_shared<const T>(make(key));
    return object;
  }

 private:
  std::mutex mutex_;
  std::map<float, std::shared_ptr<const T>> made_;
};

}  // namespace dspm
