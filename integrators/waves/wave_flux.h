// Photons gathered in waves: what gather.h makes of hit points one by one.
#pragma once

#include <functional>
#include <span>

#include "dspm/integrators/photons/hit_point_tile.h"
#include "dspm/integrators/photons/photon_map.h"
#include "dspm/integrators/photons/point_flux.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/integrators/waves/wave_tracer.h"

namespace dspm {

/// Returns whether all of the tiles' hit points and the photons have a plain form, in a scene that has one.
bool may_gather_in_waves(std::span<const HitPointTile> tiles, const PhotonMap& photons, const PlainScene& plain);

/// Returns the flux at the tiles' hit points, each within the root of radius2_of(it). `tracer` has the plain scene, and
/// may_gather_in_waves() is true.
FluxOfPoints gather_in_waves(WaveTracer& tracer, std::span<const HitPointTile> tiles, const PhotonMap& photons,
                             const std::function<float(const HitPoint&)>& radius2_of);

}  // namespace dspm
