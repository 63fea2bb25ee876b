// The reverse of a photon map: hit points by position, to find those that would gather a given photon.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/grid/point_grid.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/untouched.h"
#include "dspm/integrators/photons/curve_photons.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/photons/hit_point.h"
#include "dspm/integrators/photons/hit_point_tile.h"
#include "dspm/integrators/photons/photon.h"

namespace dspm {

class VisiblePoints {
 public:
  /// Takes every `step`-th of the tiles' hit points in these frames, with `scale` times their radius, but at most
  /// `most`. `which` selects ordinary ones or those of glossy lobes. The tiles must outlive it.
  VisiblePoints(std::span<const HitPointTile> tiles, std::vector<HitPoint> HitPointTile::*which, float scale,
                float most, std::size_t step = 1, FrameSet frames = FrameSet::first(kMaxFrames));

  /// Calls fn(radiance, frames, const HitPoint&) for every point that gathers the photon, with the luminance that its
  /// pixel gains in each of these frames. Strands do not count.
  template <class Fn>
  void for_each_gathering(const Photon& photon, Fn&& fn) const {
    for_each_around(photon, [&](const Point& point, const HitPoint& hit, FrameSet frames) {
      if (point.tile->strip_of(hit) != nullptr) return;
      const Scattering* scattering = point.tile->scattering_of(hit);
      const bool counts =
          scattering != nullptr && scattering->transmits
              ? surface_of(hit, *scattering, std::sqrt(point.radius2)).counts(photon.p, photon.wi, photon.face)
              : dot(photon.wi, hit.ng) > 0;
      if (!counts) return;
      const Spectrum f = scattering == nullptr ? Spectrum(1) : scattering->scattered(photon.wi);
      give(point.tile->palette->luminance(photon.flux * hit.throughput * f) / kernel_size(point.radius2), frames, hit,
           fn);
    });
  }
  /// Calls fn likewise for points on surfaces that turn: those of the same strip that are no further away than the
  /// circle is wide. This need not be exact.
  template <class Fn>
  void for_each_gathering(const CurvePhoton& photon, Fn&& fn) const {
    for_each_around(photon, [&](const Point& point, const HitPoint& hit, FrameSet frames) {
      const HitStrip* strip = point.tile->strip_of(hit);
      if (strip == nullptr || strip->place.shape != photon.at.shape || strip->place.strip != photon.at.strip) return;
      const float irradiance = StripKernel(strip->place, std::sqrt(point.radius2)).irradiance(photon.at, photon.wi);
      const Spectrum f = point.tile->scattering_of(hit)->scattered(photon.wi) * std::abs(dot(photon.wi, strip->ns));
      give(point.tile->palette->luminance(photon.flux * hit.throughput * f) * irradiance, frames, hit, fn);
    });
  }

 private:
  struct Point {
    const HitPoint* hit;
    const HitPointTile* tile;
    FrameSet frames;
    float radius2;
  };
  /// Points whose radii differ by less than a factor of two.
  struct OneSize {
    float most2 = 0;
    UntouchedVector<Point> points;  // in the grid's order
    PointGrid grid;
  };
  /// Calls fn(const Point&, const HitPoint&, FrameSet) for every point within whose radius the photon lies.
  template <class Fn>
  void for_each_around(const Photon& photon, Fn&& fn) const {
    for (const OneSize& size : sizes_)
      size.grid.for_each_within(photon.p, size.most2, [&](std::uint32_t i, float distance2) {
        const Point& point = size.points[i];
        const FrameSet frames = photon.frames & point.frames;
        if (distance2 <= point.radius2 && !frames.empty()) fn(point, *point.hit, frames);
      });
  }
  template <class Fn>
  static void give(float radiance, FrameSet frames, const HitPoint& hit, Fn&& fn) {
    if (radiance > 0 && std::isfinite(radiance)) fn(radiance, frames, hit);
  }

  std::vector<OneSize> sizes_;
};

}  // namespace dspm
