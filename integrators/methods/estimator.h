// Turns gathered photons and the light that camera paths saw directly into a pixel's radiance, in each of the frames
// rendered together. There are two estimators: hj09 (each pixel and frame shrinks its own radius) and kz11 (the radius
// depends only on the iteration).
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/methods/pixel_statistics.h"
#include "dspm/integrators/photons/gather.h"

namespace dspm {

class PixelEstimator {
 public:
  virtual ~PixelEstimator() = default;
  /// The square of the radius that gather_at would search: the largest of all frames.
  virtual float search_radius2(const HitPoint& hit) const = 0;
  /// The square of the radius in one of the hit point's frames.
  float search_radius2_in(Frame frame, const HitPoint& hit) const {
    const std::optional<PixelStatistics> own = statistics(hit.pixel, frame);
    return !own ? search_radius2(hit) : own->R2 > 0 ? own->R2 : hit.radius * hit.radius;
  }
  /// Gathers photons for a hit point and adds them to the pixel's sums, for each batch of an iteration's photons. Calls
  /// for different pixels may run concurrently; a pixel's hit points of one iteration hold disjoint frames.
  virtual void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, GatherCounts& counts) = 0;
  /// Adds light that needs no photons. Calls for different pixels may run concurrently.
  virtual void see(const SeenLight& light) = 0;
  /// Called once per iteration, before all gathers, with rising numbers; other machines may do those in between.
  virtual void begin_iteration(int /*iteration*/) {}
  /// Called once per iteration, after all gathers.
  virtual void end_iteration() = 0;
  /// Saves or loads all state that outlives an iteration; see Integrator::persist.
  virtual void persist(StateStream& state) = 0;
  /// Returns whether an iteration is the same whatever the others found; if not, its sums cannot be merged.
  virtual bool adds_up() const { return true; }
  /// Radiance after the completed iterations.
  virtual Rgb radiance(int pixel, Frame frame) const = 0;
  /// Returns the statistics of a pixel with a radius of its own; nullopt if only sums are kept.
  virtual std::optional<PixelStatistics> statistics(int /*pixel*/, Frame) const { return std::nullopt; }
  /// Drops the state that only end_iteration() needs. Called between iterations, or after one that threw.
  virtual void forget_iteration() {}
};

/// kz11's radius, the same for all pixels and frames except for its initial value: a function of the iteration.
class IterationRadius {
 public:
  float of(float initial) const { return initial * static_cast<float>(scale_); }
  float squared(const HitPoint& hit) const {
    const float radius = of(hit.radius);
    return radius * radius;
  }
  /// Goes to the radius of an iteration, counted from 0. After the i-th, counted from 1: s'^2 = s^2 (i + alpha) / (i +
  /// 1). [KZ11]
  void go_to(int iteration, float alpha) {
    if (iteration < iteration_) *this = {};
    while (iteration_ < iteration) {
      const auto i = static_cast<double>(++iteration_);
      scale_ *= std::sqrt((i + static_cast<double>(alpha)) / (i + 1));
    }
  }

 private:
  int iteration_ = 0;
  double scale_ = 1;
};

struct EstimatorSettings {
  int pixels = 0, frames = 1;
  std::int64_t photons = 1;  // paths emitted per iteration in each frame
  float alpha = 0.7f;
  bool batched = false;  // an iteration's photons come in several batches

  std::size_t pixel_frames() const { return static_cast<std::size_t>(pixels) * static_cast<std::size_t>(frames); }
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
