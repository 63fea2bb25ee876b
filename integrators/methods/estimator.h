// Turns gathered photons and the light that camera paths saw directly into a pixel's radiance, in each of the frames
// rendered together. There are two estimators: hj09 (each pixel and frame shrinks its own radius) and kz11 (the radius
// depends only on the iteration).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/methods/pixel_sink.h"
#include "dspm/integrators/methods/pixel_statistics.h"

namespace dspm {

struct EstimatorSettings {
  int pixels = 0, frames = 1;
  std::int64_t photons = 1;  // paths emitted per iteration in each frame
  float alpha = 0.7f;
  bool batched = false;                     // an iteration's photons come in several batches
  const IterationRadius* radius = nullptr;  // kz11's, and that of hidden light
  bool caught = false;                      // of the light on shadow catchers, which is no part of the image

  std::size_t pixel_frames() const { return static_cast<std::size_t>(pixels) * static_cast<std::size_t>(frames); }
};

class PixelEstimator : public PixelSink {
 public:
  explicit PixelEstimator(const EstimatorSettings& of) : of_(of) {}

  void see(std::span<const HitPointTile> tiles) final;
  void gather(const PhotonBatch& batch, BatchCounts& counts) final;
  std::vector<PixelOutput> outputs(int iterations) const final;

  /// The square of the radius in which the next batch's photons are sought: the largest of all frames.
  virtual float search_radius2(const HitPoint& hit) const = 0;
  /// The square of the radius in one of the hit point's frames.
  float search_radius2_in(Frame frame, const HitPoint& hit) const {
    const std::optional<PixelStatistics> own = statistics(hit.pixel, frame);
    return !own ? search_radius2(hit) : own->R2 > 0 ? own->R2 : hit.radius * hit.radius;
  }
  /// Returns the statistics of a pixel with a radius of its own; nullopt if only sums are kept.
  virtual std::optional<PixelStatistics> statistics(int /*pixel*/, Frame) const { return std::nullopt; }
  /// Returns whether the flux in the radius is all that it needs of a hit point's photons: a device may gather that.
  virtual bool takes_flux() const { return false; }
  /// Returns whether an iteration is the same whatever the others found; if not, its sums cannot be merged.
  virtual bool adds_up() const { return true; }

 protected:
  /// Gathers photons for a hit point and adds them to the pixel's sums. Calls for different pixels may run
  /// concurrently; a pixel's hit points of one iteration hold disjoint frames.
  virtual void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, GatherCounts& counts) = 0;
  /// Adds flux that a device has gathered there, as gather_at() does; only if it takes_flux().
  virtual void take(const HitPoint& /*hit*/, const HitPointTile& /*tile*/, const FluxOfPoints::Of& /*flux*/) {}
  /// Adds light that needs no photons. Calls for different pixels may run concurrently.
  virtual void add(const SeenLight& light) = 0;
  /// Radiance after the completed iterations.
  virtual Rgb radiance(int pixel, Frame frame) const = 0;
  /// Throws std::runtime_error unless radii and numbers of photons are possible; what they give is checked as an image.
  void expect_possible_statistics() const;

  const EstimatorSettings of_;

 private:
  void take_flux(const PhotonBatch& batch, std::vector<GatherCounts>& counts);
};

/// The estimator of the image, and that of the light on shadow catchers, which is null if the scene has none.
struct Estimators {
  PixelEstimator* image = nullptr;
  PixelEstimator* caught = nullptr;

  const PixelEstimator& of(const HitPoint& hit) const { return hit.caught ? *caught : *image; }
};

struct EstimatorKind {
  std::unique_ptr<PixelEstimator> (*make)(const EstimatorSettings&);
  std::size_t (*bytes)(const EstimatorSettings&);  // it will hold; unless batched, only those kept across iterations
};
template <class Estimator>
EstimatorKind estimator_kind() {
  return {
      [](const EstimatorSettings& of) -> std::unique_ptr<PixelEstimator> { return std::make_unique<Estimator>(of); },
      Estimator::bytes};
}

}  // namespace dspm
