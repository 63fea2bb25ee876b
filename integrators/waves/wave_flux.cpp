#include "dspm/integrators/waves/wave_flux.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/base/system/parallel.h"
#include "dspm/base/system/untouched.h"
#include "dspm/integrators/waves/gather_wave.h"

namespace dspm {
namespace {

template <class Fn>
void for_each_tile(std::span<const HitPointTile> tiles, const Fn& fn) {
  parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t t) { fn(static_cast<std::size_t>(t)); });
}

/// Returns whether a device can make the Bsdf at a hit point anew. It does not average textures over what a path stands for, and
/// has one material for all frames of a hit point.
bool is_plain(const HitPoint& hit, const Scattering& at, const PlainScene& plain) {
  if (hit.wavelength.nm != 0 || at.strip >= 0 || at.hit.missed() || at.ns != at.unbent_ns) return false;
  const std::size_t place = plain.place_in(plain.place_of_material(at.hit, at.inside), hit.frames.lowest());
  const PlainState& state = plain.states[place];
  return (state == PlainState() || state.frames.contains(hit.frames)) && !plain.materials[place].averages();
}

}  // namespace

bool may_gather_in_waves(std::span<const HitPointTile> tiles, const PhotonMap& photons, const PlainScene& plain) {
  if (photons.has_strands() || photons.only_nm() != 0) return false;
  std::atomic<bool> may = true;
  for_each_tile(tiles, [&](std::size_t t) {
    const HitPointTile& tile = tiles[t];
    const bool plain_here = std::ranges::all_of(tile.hit_points, [&](const HitPoint& hit) {
      const Scattering* const scattering = tile.scattering_of(hit);
      return scattering == nullptr || is_plain(hit, *scattering, plain);
    });
    if (!plain_here) may = false;
  });
  return may;
}

FluxOfPoints gather_in_waves(WaveTracer& tracer, std::span<const HitPointTile> tiles, const PhotonMap& photons,
                             const std::function<float(const HitPoint&)>& radius2_of) {
  std::vector<std::uint32_t> first_point{0}, first_scattering{0};
  for (const HitPointTile& tile : tiles) {
    first_point.push_back(first_point.back() + static_cast<std::uint32_t>(tile.hit_points.size()));
    first_scattering.push_back(first_scattering.back() + static_cast<std::uint32_t>(tile.scatterings.size()));
  }
  UntouchedVector<GatherPoint> points(first_point.back());
  UntouchedVector<GatherScattering> scatterings(first_scattering.back());
  for_each_tile(tiles, [&](std::size_t t) {
    GatherPoint* point = points.data() + first_point[t];
    for (const HitPoint& hit : tiles[t].hit_points) {
      const std::uint32_t scattering = hit.scattering < 0
                                           ? GatherPoint::kConstant
                                           : first_scattering[t] + static_cast<std::uint32_t>(hit.scattering);
      *point++ = {hit.p, hit.ng, radius2_of(hit), hit.face, hit.frames, scattering};
    }
    GatherScattering* to = scatterings.data() + first_scattering[t];
    for (const Scattering& at : tiles[t].scatterings)
      *to++ = {at.hit, at.wo, at.p_error, at.lobes, at.transmits, at.inside};
  });
  std::vector<PlainPhotonGrid> of_frame;
  FluxOfPoints flux = tracer.gather(photons.plain(of_frame), points, scatterings);
  flux.first_point = std::move(first_point);
  return flux;
}

}  // namespace dspm
