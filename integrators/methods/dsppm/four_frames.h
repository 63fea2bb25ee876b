// A pixel's statistics in four frames side by side: the SIMD twin of PixelStatistics and PassSums. It does the same
// operations in the same order, so its values are identical bit for bit.
#pragma once

#include <algorithm>
#include <cstdint>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/spectrum_lanes.h"
#include "dspm/base/math/frame_lanes.h"
#include "dspm/base/math/simd.h"
#include "dspm/integrators/methods/pixel_statistics.h"

namespace dspm {

/// The photons that all frames of a hit point share, and their flux times f.
struct FoundFlux {
  std::uint32_t M = 0;
  Spectrum flux;

  FoundFlux& operator+=(const FoundFlux& o) {
    M += o.M, flux += o.flux;
    return *this;
  }
};

/// PassSums of four frames; phi is what paths carry until total() sees it. M stays below 2^24, where a float is exact:
/// there are fewer photons.
struct FourSums {
  __m128 M, phi[3];

  /// Adds photons in the frames of `lanes`.
  void add(__m128 lanes, const Spectrum& flux, float photons = 1) {
    M = _mm_add_ps(M, _mm_and_ps(lanes, _mm_set1_ps(photons)));
    for (int c = 0; c < 3; ++c) phi[c] = _mm_add_ps(phi[c], _mm_and_ps(lanes, _mm_set1_ps(flux[c])));
  }
  /// Adds the sums shared by all frames of `lanes` and multiplies by the path's throughput.
  FourSums total(__m128 lanes, const FoundFlux& shared, const Spectrum& throughput, const Palette& palette) const {
    FourSums sums;
    sums.M = _mm_and_ps(lanes, _mm_add_ps(M, _mm_set1_ps(static_cast<float>(shared.M))));
    for (int c = 0; c < 3; ++c)
      sums.phi[c] =
          _mm_and_ps(lanes, _mm_mul_ps(_mm_add_ps(phi[c], _mm_set1_ps(shared.flux[c])), _mm_set1_ps(throughput[c])));
    if (!palette.is_rgb()) sums.see(palette);
    return sums;
  }
  void see(const Palette& palette) {
    __m128 seen[3] = {_mm_setzero_ps(), _mm_setzero_ps(), _mm_setzero_ps()};
    for (int k = 0; k < 3; ++k) {
      const Rgb of_one = palette.seen(k);
      for (int c = 0; c < 3; ++c) seen[c] = _mm_add_ps(seen[c], _mm_mul_ps(phi[k], _mm_set1_ps(of_one[c])));
    }
    std::copy_n(seen, 3, phi);
  }
  FourSums& operator+=(const FourSums& o) {
    M = _mm_add_ps(M, o.M);
    for (int c = 0; c < 3; ++c) phi[c] = _mm_add_ps(phi[c], o.phi[c]);
    return *this;
  }
};

class FourFrames {
 public:
  /// Sets the first hit point's radius in the frames of `lanes`.
  void begin(__m128 lanes, float radius2) {
    const __m128 first = _mm_and_ps(lanes, _mm_cmpeq_ps(R2_, _mm_setzero_ps()));
    if (_mm_movemask_ps(first) == 0) return;
    const __m128 start = _mm_set1_ps(radius2);
    R2_ = _mm_blendv_ps(R2_, start, first);
    for (__m128& tau : tau_) tau = _mm_blendv_ps(tau, _mm_mul_ps(tau, start), first);
  }
  __m128 R2() const { return R2_; }

  /// Updates the statistics [WG12 (1), (2), (4)]; frames without photons do not change.
  void absorb(const FourSums& sums, float alpha) {
    const __m128 none = _mm_cmpeq_ps(sums.M, _mm_setzero_ps());
    if (_mm_movemask_ps(none) == 15) return;
    __m128 shrink[2];
    const __m128d share = _mm_set1_pd(static_cast<double>(alpha));
    for (int half = 0; half < 2; ++half) {
      const __m128d M = _mm_cvtps_pd(half == 0 ? sums.M : _mm_movehl_ps(sums.M, sums.M));
      const __m128d accepted = _mm_add_pd(N_[half], _mm_mul_pd(share, M));
      shrink[half] = _mm_cvtpd_ps(_mm_div_pd(accepted, _mm_add_pd(N_[half], M)));
      N_[half] = accepted;
    }
    const __m128 by = _mm_blendv_ps(_mm_movelh_ps(shrink[0], shrink[1]), _mm_set1_ps(1), none);
    for (int c = 0; c < 3; ++c) tau_[c] = _mm_mul_ps(_mm_add_ps(tau_[c], sums.phi[c]), by);
    R2_ = _mm_mul_ps(R2_, by);
  }

  PixelStatistics of(int lane) const {
    PixelStatistics s;
    s.N = lane_of(N_[lane / 2], lane % 2), s.R2 = lane_of(R2_, lane);
    s.tau = {lane_of(tau_[0], lane), lane_of(tau_[1], lane), lane_of(tau_[2], lane)};
    return s;
  }
  /// Does what PixelStatistics::see does, in one lane.
  void see(int lane, const Rgb& radiance, float emitted) {
    PixelStatistics s = of(lane);
    s.see(radiance, emitted);
    for (int c = 0; c < 3; ++c) reinterpret_cast<float*>(&tau_[c])[lane] = s.tau[c];
  }

 private:
  static float lane_of(const __m128& v, int lane) { return reinterpret_cast<const float*>(&v)[lane]; }
  static double lane_of(const __m128d& v, int lane) { return reinterpret_cast<const double*>(&v)[lane]; }

  __m128d N_[2] = {_mm_setzero_pd(), _mm_setzero_pd()};
  __m128 R2_ = _mm_setzero_ps(), tau_[3] = {_mm_setzero_ps(), _mm_setzero_ps(), _mm_setzero_ps()};
};

}  // namespace dspm
