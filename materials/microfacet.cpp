// Sampling of visible facet normals: stretched to alpha = 1 the facets form a hemisphere, whose mirrored directions
// fill a spherical cap; its points are uniform.
#include "dspm/materials/microfacet.h"

namespace dspm {

Vec3 Ggx::sample_visible(const Vec3& wo, float u, float v) const {
  const Vec3 stretched = normalize({alpha_x_ * wo.x, alpha_y_ * wo.y, wo.z});
  const float z = (1 - v) * (1 + stretched.z) - stretched.z, radius = std::sqrt(std::max(0.f, 1 - z * z));
  const float phi = 2 * kPi * u;
  const Vec3 halfway = stretched + Vec3{radius * std::cos(phi), radius * std::sin(phi), z};
  return normalize({alpha_x_ * halfway.x, alpha_y_ * halfway.y, std::max(halfway.z, 1e-9f)});
}

}  // namespace dspm
