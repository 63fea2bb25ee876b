// Those who keep something of what a progressive integrator's iterations find, pixel by pixel: the image, the light on
// shadow catchers, groups of lights, numbers of photons. None of them changes what the others get.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/output_info.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/photons/hidden_light.h"
#include "dspm/integrators/photons/medium_photons.h"
#include "dspm/integrators/photons/point_flux.h"

namespace dspm {

/// The hit points of an iteration, and as many of its photons as fit into memory.
struct PhotonBatch {
  std::span<const HitPointTile> tiles;
  const PhotonMap& photons;
  const HiddenPhotons& hidden;
  const MediumPhotons& in_media;
  const FluxOfPoints* flux = nullptr;  // that a device has gathered at the tiles' hit points; null: none has
};

/// The work of gathering a batch, by tile.
struct BatchCounts {
  std::vector<GatherCounts> photons, hidden;

  explicit BatchCounts(std::size_t tiles) : photons(tiles), hidden(tiles) {}
};

struct PixelOutput {
  OutputInfo info;
  std::function<Rgb(int pixel, Frame)> value;
};

class PixelSink {
 public:
  virtual ~PixelSink() = default;
  /// Adds light that needs no photons: once in an iteration, before its first batch.
  virtual void see(std::span<const HitPointTile> /*tiles*/) {}
  /// Gathers a batch of the iteration's photons. Only the work that makes images is counted.
  virtual void gather(const PhotonBatch& batch, BatchCounts& counts) = 0;
  /// Called once in an iteration, after its last batch.
  virtual void end_iteration() {}
  /// Saves or loads all state that outlives an iteration, and drops the rest: an iteration may have been cancelled. See
  /// Integrator::persist.
  virtual void persist(StateStream& state) = 0;
  /// The images that it gives after so many iterations. Their values are read while it is not changed.
  virtual std::vector<PixelOutput> outputs(int iterations) const = 0;
};

}  // namespace dspm
