// An integrator whose iterations follow one camera path through each pixel, tile by tile, and sum up what these see.
#pragma once

#include <cstdint>
#include <utility>

#include "dspm/integrators/integrator.h"
#include "dspm/integrators/summing_integrator.h"
#include "dspm/integrators/trace_tiles.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class TileTraced : public SummingIntegrator {
 public:
  int iterations() const override { return iterations_; }

  void iterate(const Iteration& iteration) override {
    done_.advance([&](SeenLightSums& sums, Statistics& statistics) {
      const StepTimer timer(statistics.steps[0]);
      trace(iteration, sums, statistics);
    });
  }

 protected:
  /// Has one step in `begin`. For `frames`, a number or the scene, see SummingIntegrator.
  template <class Frames>
  TileTraced(int iterations, const Frames& frames, const RenderSettings& render, Statistics begin)
      : SummingIntegrator(frames, render, std::move(begin)), iterations_(iterations), render_(render) {}

  /// Traces all tiles and adds to `sums` and `statistics`.
  virtual void trace(const Iteration& iteration, SeenLightSums& sums, Statistics& statistics) const = 0;

  /// Follows a camera path through each pixel with a tracer of make_tracer(const Scene&) for each tile; see trace_tiles().
  template <class MakeTracer>
  void trace_pixels(const Iteration& iteration, Statistics& statistics, MakeTracer&& make_tracer) const {
    iteration.for_each_moment([&](const Scene& scene, const MomentPixels& pixels) {
      trace_tiles(render_.crop, pixels, static_cast<std::uint64_t>(iteration.number), statistics,
                  [&] { return make_tracer(scene); });
    });
  }

  const RenderSettings& render() const { return render_; }

 private:
  int iterations_;
  RenderSettings render_;
};

}  // namespace dspm
