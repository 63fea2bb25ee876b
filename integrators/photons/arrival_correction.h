// What bent normals add to the flux of photons that arrive.
#pragma once

#include <optional>

#include "dspm/base/math/vec.h"

namespace dspm {

/// Returns |cos(wi, ns) / cos(wi, ng)|, by which a photon's flux counts so that a gather needs no cosine; nullopt if the
/// normals disagree about the side of wi: every scattering function is zero then.
constexpr std::optional<float> arrival_correction(const Vec3& ns, const Vec3& ng, const Vec3& wi) {
  if (ns == ng) return 1;
  const float geometric = dot(wi, ng), shading = dot(wi, ns);
  return geometric * shading > 0 ? std::optional<float>(shading / geometric) : std::nullopt;
}

}  // namespace dspm
