// The ways by which a progressive integrator's iterations find light, with what is learned of them before the first:
// where photons start, whether camera paths go on from hit points, and who brings direct light.
#pragma once

#include <memory>
#include <optional>

#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/integrators/methods/pixel_statistics.h"
#include "dspm/integrators/methods/progressive_settings.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class LearnedWays {
 public:
  LearnedWays(const ProgressiveSettings& given, const Scene& scene);
  LearnedWays(const LearnedWays&) = delete;
  LearnedWays& operator=(const LearnedWays&) = delete;

  bool are_known() const { return learned_ != nullptr; }
  void learn(const Scene& scene, const RenderSettings& render, Statistics& statistics);
  /// Returns the settings of an iteration whose radii are those. They point into this object.
  const ProgressiveSettings& of_iteration(const Scene& scene, const IterationRadius& radius);
  void start_statistics(const Scene& scene, const RenderSettings& render, Statistics& statistics) const;
  /// Counts what these settings leave out, after an iteration.
  void count_iteration(const Scene& scene, const RenderSettings& render, int number, Statistics& statistics) const;
  /// Returns the settings with what is learned but for the balance of direct light.
  const ProgressiveSettings& settings() const { return settings_; }
  /// The most that learning has taken.
  std::size_t bytes() const { return learned_ != nullptr ? learned_->bytes_while_learning : 0; }
  void persist(StateStream& state);

 private:
  void apply();

  const ProgressiveSettings given_;
  ProgressiveSettings settings_;
  int lights_;
  std::shared_ptr<const LearnedEmission> learned_;  // null before the first iteration
  std::optional<DirectBalance> direct_;             // of the iteration
};

}  // namespace dspm
