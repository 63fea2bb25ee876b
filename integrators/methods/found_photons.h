// The outputs "photons" and "radius" of progressive integrators: what the gathers at each pixel find, in each frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/pixel_frames.h"

namespace dspm {

/// Counts in gathers of its own, so that those of the estimators stay as fast as they are.
class FoundPhotons final : public PixelSink {
 public:
  /// Keeps nothing unless one of the outputs is among `asked`.
  FoundPhotons(const EstimatorSettings& of, const Estimators& estimators, const std::vector<std::string>& asked);
  static std::size_t bytes(const EstimatorSettings& of, const std::vector<std::string>& asked);

  /// Asks the estimators for their radii, so it is called before theirs.
  void gather(const PhotonBatch& batch, BatchCounts& counts) override;
  void persist(StateStream& state) override { state.sum(pixels_.values()); }
  std::vector<PixelOutput> outputs(int iterations) const override;

 private:
  struct Pixel {
    std::uint32_t photons = 0;
    float initial_radius = 0;

    Pixel& operator+=(const Pixel& o) {
      photons += o.photons;
      if (o.initial_radius > 0) initial_radius = o.initial_radius;
      return *this;
    }
  };
  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map);
  /// Returns the radius for the next iteration.
  float radius(int pixel, Frame frame) const;

  Estimators estimators_;
  const IterationRadius& radius_;
  bool counts_;  // photons; else only the radius is kept
  PixelFrames<Pixel> pixels_;
};

}  // namespace dspm
