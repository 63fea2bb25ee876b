// Gathering as a wave: what gather.h does, for each hit point by a call of its own. A call reads plain values only, and visits
// photons in the order in which the CPU does, so sums have its bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/plain_photon_map.h"
#include "dspm/integrators/photons/point_flux.h"
#include "dspm/integrators/photons/same_surface.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/integrators/waves/shared_sums.h"
#include "dspm/world/scene/inside.h"

namespace dspm {

/// What a hit point is for a gather.
struct GatherPoint {
  static constexpr std::uint32_t kConstant = 0xffffffff;

  Vec3 p, ng;
  float radius2;
  ShapeFace face;
  FrameSet frames;
  std::uint32_t scattering;  // kConstant: f is, and among the throughput
};

/// What a hit point is whose f is not constant.
struct GatherScattering {
  RayHit hit;
  Vec3 wo, p_error;
  LobeSet lobes;
  bool transmits;
  Inside inside;  // the bodies around the hit point
};

/// The sums of one hit point, see GatheredFlux.
class PlainGatheredFlux {
 public:
  constexpr explicit PlainGatheredFlux(FrameSet frames) : frames_(frames) {}

  constexpr void add(FrameSet frames, const Spectrum& flux) {
    if (frames == frames_) {
      shared_ += flux;
      return;
    }
    with_own_ |= frames;
    frames.for_each([&](Frame f) { own_[f] += flux; });
  }

  constexpr const Spectrum& shared() const { return shared_; }
  constexpr FrameSet with_own() const { return with_own_; }
  constexpr const Spectrum& own(Frame frame) const { return own_[frame]; }

 private:
  FrameSet frames_, with_own_;
  Spectrum shared_, own_[kMaxFrames];
};

struct GatherSteps {
  PlainScene scene;
  PlainPhotonMap map;
  const GatherPoint* points;
  const GatherScattering* scatterings;
  PointFlux* to;
  WaveList<Spectrum> own = {};
  WaveList<FluxOfPoints::Rejection> rejections = {};

  constexpr void operator()(std::size_t i) const {
    const GatherPoint& point = points[i];
    if (point.scattering != GatherPoint::kConstant) return gather_scattered(i, scatterings[point.scattering]);
    gather(i, kSound, [&](const PlainPhotonGrid& in, std::uint32_t place, Spectrum& flux) {
      const GatheredPhoton& photon = in.photons[place];
      flux = photon.flux;
      return dot(photon.wi, point.ng) > 0;
    });
  }
  void append_to(const WaveList<Spectrum>& to_own, const WaveList<FluxOfPoints::Rejection>& to_rejections) {
    own = to_own, rejections = to_rejections;
  }

 private:
  static constexpr int kSound = -1;  // in place of a material: nothing that it gives is to be rejected

  constexpr void gather_scattered(std::size_t i, const GatherScattering& at) const {
    const GatherPoint& point = points[i];
    const PlainPlacedShape& shape = scene.shape_of(at.hit);
    const SameSurface surface(point.p, point.ng, at.p_error, point.face, rounded::sqrt(point.radius2));
    const SurfaceGeometry met = shape.surface_point(at.hit.primitive, at.hit.uv);
    scene.materials[scene.place_in(scene.place_of_material(at.hit, at.inside), point.frames.lowest())].with_bsdf(
        met, {}, [&](const auto& bsdf) {
          gather(i, shape.material, [&](const PlainPhotonGrid& in, std::uint32_t place, Spectrum& flux) {
            const GatheredPhoton& photon = in.photons[place];
            const bool counts = at.transmits ? surface.counts(in.grid.point(place), photon.wi, in.faces[place])
                                             : dot(photon.wi, point.ng) > 0;
            if (counts) flux = photon.flux * bsdf.evaluate(at.wo, photon.wi, Transport::radiance, at.lobes);
            return counts;
          });
        });
  }

  /// flux_of(grid, place, flux) returns whether a photon counts, and sets its flux times f. (g++ would pass a std::optional
  /// through memory, slowly.)
  template <class FluxOf>
  constexpr void gather(std::size_t i, int material, const FluxOf& flux_of) const {
    const GatherPoint& point = points[i];
    PlainGatheredFlux sums(point.frames);
    std::uint32_t found = 0, separate = 0, rejected = 0;
    const auto add = [&](const PlainPhotonGrid& in, std::uint32_t place) {
      const FrameSet frames = in.photons[place].frames & point.frames;
      ++found, separate += static_cast<std::uint32_t>(frames.count());
      if (frames.empty()) return;
      Spectrum flux;
      if (!flux_of(in, place, flux)) return;
      if (material == kSound || is_light(flux))
        sums.add(frames, flux);
      else
        rejections.append({static_cast<std::uint32_t>(i), rejected++, material, frames});
    };
    const std::uint64_t tests = map.for_each_within(point.p, point.radius2, point.frames, add);
    to[i] = {sums.shared(), store_own(sums), sums.with_own(), found, separate, static_cast<std::uint32_t>(tests)};
  }

  constexpr std::uint32_t store_own(const PlainGatheredFlux& sums) const {
    const auto count = static_cast<std::uint32_t>(sums.with_own().count());
    if (count == 0) return 0;
    const std::uint32_t first = add_among_all(*own.size, count);
    if (first + count > own.room) return first;
    std::uint32_t place = first;
    sums.with_own().for_each([&](Frame f) { own.items[place++] = sums.own(f); });
    return first;
  }
};

}  // namespace dspm
