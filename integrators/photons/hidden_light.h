// Light that only photons bring to a glossy lobe: see docs/photons.md, Hidden light. Such lobes extend camera
// paths, but no ray hits a light without extent, and no shadow ray reaches it through glass.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/curve_photons.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/transport/light_value.h"

namespace dspm {

struct HiddenPhotons {
  PhotonMap on_surfaces;
  CurvePhotons on_curves;

  HiddenPhotons() = default;
  explicit HiddenPhotons(const LightGroups& groups) : on_surfaces(groups), on_curves(groups) {}

  /// Builds both maps as PhotonMap::build does.
  void build(const std::vector<PhotonTrace>& traces, int frames, float cell_size);
  std::size_t bytes() const { return on_surfaces.bytes() + on_curves.bytes(); }
};

/// Does gather_by_group() for a hit point on a surface that turns to rays. A photon's flux is what would give the same
/// radiance if it were spread over a disc.
template <class Fn>
void gather_on_curve(const HitPoint& hit, const Scattering& scattering, const HitStrip& strip,
                     const CurvePhotons& photons, float radius2, GatherCounts& counts, Fn&& fn) {
  counts.gathers.add(hit.frames.count());
  SharedCount within;
  const auto add = [&](const CurvePhoton& photon, const Strand* strands, float irradiance, const auto& group) {
    const FrameSet frames = photon.frames & hit.frames;
    within.add(frames.count());
    if (frames.empty()) return;
    const Spectrum f = scattering.bsdf->evaluate(scattering.wo, photon.wi, Transport::radiance, scattering.lobes);
    const bool has_hue = hit.wavelength.alone || scattering.bsdf->disperses(scattering.wo, photon.wi);
    const float share = irradiance * std::abs(dot(photon.wi, strip.ns)) * kernel_size(radius2);
    const Spectrum flux = photon.flux * hue_of_found(photon.only_nm, has_hue) * f * share;
    if (!is_light(flux))
      return counts.rejections.add({SceneElement::Kind::material, scattering.material}, frames, hit.pixel);
    fn(strands, frames, SpectrumLanes(flux), 0.f, group);
  };
  counts.tests += photons.for_each_within(strip.place, std::sqrt(radius2), add);
  counts.found += within;
}

/// Does gather_by_group() for a glossy hit point.
template <class Fn>
void gather_hidden_by_group(const HitPoint& hit, const HitPointTile& tile, const HiddenPhotons& hidden, float radius2,
                            GatherCounts& counts, Fn&& fn) {
  if (const HitStrip* strip = tile.strip_of(hit))
    gather_on_curve(hit, *tile.scattering_of(hit), *strip, hidden.on_curves, radius2, counts, fn);
  else
    gather_by_group(hit, tile.scattering_of(hit), hidden.on_surfaces, radius2, counts, fn);
}

/// Calls fn(FrameSet, radiance) with the radiance that the hidden photons within sqrt(radius2) of a glossy hit point
/// send along its camera path, per emitted photon path; the sets are disjoint and leave out frames without photons.
template <class Fn>
void gather_hidden(const HitPoint& hit, const HitPointTile& tile, const HiddenPhotons& hidden, float radius2,
                   GatherCounts& counts, Fn&& fn) {
  std::array<Spectrum, kMaxFrames> flux;
  FrameSet lit;
  gather_hidden_by_group(
      hit, tile, hidden, radius2, counts,
      [&](const Strand* strands, FrameSet frames, SpectrumLanes photon, float, const auto&) {
        for_each_strand(strands, frames, [&](FrameSet alike, const Spectrum& weight) {
          (alike - lit).for_each([&](Frame f) { flux[static_cast<std::size_t>(f)] = {}; });
          lit |= alike;
          alike.for_each([&](Frame f) { flux[static_cast<std::size_t>(f)] += photon.spectrum() * weight; });
        });
      });
  const Spectrum per_area = hit.throughput / kernel_size(radius2);
  for_each_strand(tile.strands.of(hit.strands), lit, [&](FrameSet alike, const Spectrum& weight) {
    alike.for_each([&](Frame f) { fn(FrameSet::single(f), flux[static_cast<std::size_t>(f)] * per_area * weight); });
  });
}

}  // namespace dspm
