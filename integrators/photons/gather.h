// Gathers photons at hit points: the inner loops of every photon map integrator. A photon that passes the tests of
// distance (in the grid), frames, and the side of the surface gives its flux times f. Hit points and photons are values
// and no pixel is in two tiles, so tiles may be gathered anywhere, in any order. [WG12 4.3]
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/spectrum_lanes.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/hit_point_tile.h"
#include "dspm/integrators/photons/photon_map.h"
#include "dspm/integrators/photons/same_surface.h"
#include "dspm/integrators/transport/light_value.h"

namespace dspm {

/// The work of gathers: points, photons found, and distance tests.
struct GatherCounts {
  SharedCount gathers, found;
  std::uint64_t tests = 0;
  Rejections rejections;
};

/// Counts photons that arrive at the front of a surface. Those that arrive at its back do not count, unless its lobes
/// transmit.
class SurfaceSide {
 public:
  explicit SurfaceSide(const HitPoint& hit) : normal_(_mm_setr_ps(hit.ng.x, hit.ng.y, hit.ng.z, 0)) {}
  bool counts(const GatheredPhoton& photon) const {
    return _mm_cvtss_f32(_mm_dp_ps(photon.wi_lanes(), normal_, 0x71)) > 0;
  }

 private:
  __m128 normal_;
};

inline SameSurface surface_of(const HitPoint& hit, const Scattering& scattering, float radius) {
  return {hit.p, hit.ng, scattering.p_error, hit.face, radius};
}

/// The flux of photons as it is.
struct AllColours {
  static SpectrumLanes lanes(const GatheredPhoton& photon) { return photon.flux_lanes(); }
  static const Spectrum& spectrum(const GatheredPhoton& photon) { return photon.flux; }
};

/// The flux of photons some of which have one wavelength alone, as a hit point finds it: with the hue, unless its throughput or
/// its f have it.
struct SomeOfOneWavelength {
  const HitPoint& hit;
  const Scattering* scattering;
  SpectrumLanes hue;

  SpectrumLanes lanes(const GatheredPhoton& photon) const {
    if (!photon.has_one_wavelength()) return photon.flux_lanes();
    const bool has_hue = hit.wavelength.alone || (scattering && scattering->bsdf->disperses(scattering->wo, photon.wi));
    return photon.flux_lanes(has_hue ? SpectrumLanes(Spectrum(1)) : hue);
  }
  Spectrum spectrum(const GatheredPhoton& photon) const { return lanes(photon).spectrum(); }
};

template <class Flux, class Fn>
void gather_flux(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map, float radius2,
                 GatherCounts& counts, const Flux& flux_of, Fn&& fn) {
  counts.gathers.add(hit.frames.count());
  SharedCount within;
  if (!scattering) {  // separate, since most gather time is spent in this loop
    const SurfaceSide side(hit);
    counts.tests +=
        map.for_each_within(hit.p, radius2, hit.frames, [&](const auto& photon, float distance2, const auto& details) {
          const FrameSet frames = photon.frames & hit.frames;
          within.add(frames.count());
          if (!frames.empty() && side.counts(photon))
            fn(strands_of(photon), frames, flux_of.lanes(photon), distance2, [&] { return details.group(); });
        });
  } else {
    const SameSurface surface = surface_of(hit, *scattering, std::sqrt(radius2));
    counts.tests +=
        map.for_each_within(hit.p, radius2, hit.frames, [&](const auto& photon, float distance2, const auto& details) {
          const FrameSet frames = photon.frames & hit.frames;
          within.add(frames.count());
          if (frames.empty()) return;
          if (scattering->transmits ? !surface.counts(details.p(), photon.wi, details.face())
                                    : !(dot(photon.wi, hit.ng) > 0))
            return;
          const Spectrum flux = flux_of.spectrum(photon) * scattering->scattered(photon.wi);
          if (!is_light(flux))
            counts.rejections.add({SceneElement::Kind::material, scattering->material}, frames, hit.pixel);
          fn(strands_of(photon), frames, SpectrumLanes(is_light(flux) ? flux : Spectrum()), distance2,
             [&] { return details.group(); });
        });
  }
  counts.found += within;
}

/// Calls fn(strands, frames, flux times f as SpectrumLanes, distance squared, group) for every photon within sqrt(radius2)
/// that counts for the hit point in some frame: photons arriving at the back of the surface do not, unless its lobes
/// transmit, and then only those of the same surface. The caller applies the throughput and the photon's strands, which
/// are mostly null. For group(), see PhotonMap.
template <class Fn>
void gather_by_group(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map, float radius2,
                     GatherCounts& counts, Fn&& fn) {
  if (map.only_nm() == 0) return gather_flux(hit, scattering, map, radius2, counts, AllColours{}, fn);
  gather_flux(hit, scattering, map, radius2, counts,
              SomeOfOneWavelength{hit, scattering, SpectrumLanes(hue(map.only_nm()))}, fn);
}

/// Calls fn without the group; otherwise the same as gather_by_group().
template <class Fn>
void gather_photons(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map, float radius2,
                    GatherCounts& counts, Fn&& fn) {
  gather_by_group(hit, scattering, map, radius2, counts,
                  [&fn](const Strand* strands, FrameSet frames, SpectrumLanes flux, float distance2, auto) {
                    fn(strands, frames, flux, distance2);
                  });
}

/// Calls fn(tile, its counts) for each of a batch of tiles, in parallel.
template <class Fn>
void gather_tiles(std::span<const HitPointTile> tiles, std::span<GatherCounts> counts, Fn&& fn) {
  parallel_for(static_cast<std::int64_t>(tiles.size()), 1,
               [&](std::int64_t t) { fn(tiles[static_cast<std::size_t>(t)], counts[static_cast<std::size_t>(t)]); });
}

/// The flux that photons bring to a hit point: one sum for photons of all its frames, and sums frame by frame for the
/// rest.
class GatheredFlux {
 public:
  GatheredFlux(const HitPoint& hit, const PhotonMap& map) : frames_(hit.frames), map_(map) {}

  /// Adds what gather_photons() reports of a photon; `frames` may be fewer.
  void add(const Strand* strands, FrameSet frames, SpectrumLanes flux) {
    if (strands == nullptr && frames == frames_)
      shared_ += flux;
    else if (strands == nullptr)
      add_own(frames, flux);
    else if (SpectrumLanes* sum = frames == frames_ && map_.is_of_light(strands) ? lists_.of(strands) : nullptr)
      *sum += flux;
    else
      add_strands(strands, frames, flux);
  }
  /// Call this after the last photon and before reading the sums.
  void end() {
    lists_.for_each([&](const Strand* list, SpectrumLanes flux) { add_strands(list, frames_, flux); });
  }

  Spectrum shared() const { return shared_.spectrum(); }
  /// The frames that received more than shared().
  FrameSet with_own() const { return with_own_; }
  Spectrum own(Frame frame) const { return SpectrumLanes(own_[frame]).spectrum(); }
  Spectrum in(Frame frame) const { return with_own_.contains(frame) ? shared() + own(frame) : shared(); }

 private:
  void add_own(FrameSet frames, SpectrumLanes flux) {
    (frames - with_own_).for_each([&](Frame f) { own_[f] = _mm_setzero_ps(); });
    with_own_ |= frames;
    frames.for_each([&](Frame f) { own_[f] = _mm_add_ps(own_[f], flux.lanes); });
  }
  void add_strands(const Strand* strands, FrameSet frames, SpectrumLanes flux) {
    for_each_strand(strands, frames, [&](FrameSet alike, const Spectrum& weight) {
      add_own(alike, SpectrumLanes(_mm_mul_ps(flux.lanes, SpectrumLanes(weight).lanes)));
    });
  }

  FrameSet frames_;
  const PhotonMap& map_;
  SpectrumLanes shared_;
  FewListSums<SpectrumLanes> lists_;
  FrameSet with_own_;
  __m128 own_[kMaxFrames];  // valid only for the frames in with_own_
};

/// Adds the counts of all tiles to `statistics`.
void account(std::span<const GatherCounts> tiles, Statistics& statistics);

}  // namespace dspm
