// Which photons around a point of a surface count for it. With kernel_size.h and a hit point's scattering, all that
// estimators know of surfaces.
#pragma once

#include "dspm/colour/rgb_lanes.h"
#include "dspm/integrators/hit_point.h"

namespace dspm {

/// Photons arriving at the back of the surface do not count, unless its lobes transmit.
class SurfaceSide {
 public:
  explicit SurfaceSide(const HitPoint& hit) : normal_(_mm_setr_ps(hit.ng.x, hit.ng.y, hit.ng.z, 0)) {}
  template <class PhotonType>
  bool counts(const PhotonType& photon) const {
    return _mm_cvtss_f32(_mm_dp_ps(photon.wi_lanes(), normal_, 0x71)) > 0;
  }

 private:
  __m128 normal_;
};

}  // namespace dspm
