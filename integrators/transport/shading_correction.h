// What bent normals add to the scattering of flux.
#pragma once

#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// Returns the factor to a photon's flux from wo to wi, in addition to f |cos(wi, ns)|, if shading and geometric
/// normals differ. [Veach 1997, 5.3]
constexpr float shading_correction(const SurfaceGeometry& point, const Vec3& wo, const Vec3& wi) {
  if (point.ns == point.ng) return 1;
  const float below = std::abs(dot(wo, point.ng) * dot(wi, point.ns));
  return below == 0 ? 0 : std::abs(dot(wo, point.ns) * dot(wi, point.ng)) / below;
}

}  // namespace dspm
