// A light transport algorithm that gets better with every iteration, for all frames of an interval at once. The driver
// owns the stop rule, progress and the writing of images; an integrator only iterates and answers.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "dspm/film/pixel_filter.h"
#include "dspm/film/pixel_rect.h"
#include "dspm/image/image.h"
#include "dspm/integrators/pixel_statistics.h"
#include "dspm/integrators/statistics.h"
#include "dspm/math/frames.h"
#include "dspm/params/params.h"
#include "dspm/params/registry.h"
#include "dspm/scene/scene.h"
#include "dspm/system/state_stream.h"

namespace dspm {

/// What the driver decided, equal for every integrator.
struct RenderSettings {
  int width = 0, height = 0;  // of the full image
  PixelRect crop;             // what is rendered of it
  std::shared_ptr<const PixelFilter> filter;
  bool jitter = true;  // false: every camera path through the pixel's centre
  std::uint64_t seed = 0;
  int default_iterations = 256;  // where the integrator's parameters give none
  std::size_t memory = 0;        // bytes that the integrator may hold, else it throws NotEnoughMemory; 0: no bound
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Iterations that were asked for; 0: until stopped.
  virtual int iterations() const = 0;
  /// The settings that matter to its user, in words, for the log: "300000 photons, ...".
  virtual std::string settings() const = 0;
  /// All frames take one step; iterations count from 0 and come in order. May throw; persist() then loads what was saved
  /// before, and a session does that for iterations that are given up.
  virtual void iterate(int iteration) = 0;
  /// Radiance of a frame of the interval after the iterations so far, over the crop.
  virtual Image estimate(Frame frame) const = 0;
  /// What a progressive integrator remembers of a pixel of the crop; nothing for others. For looking inside.
  virtual std::optional<PixelStatistics> pixel_statistics(int /*pixel*/, Frame) const { return std::nullopt; }
  /// Work and time so far.
  virtual Statistics statistics() const = 0;
  /// Between iterations: counts, saves or loads what they have left behind, so that another integrator of the same
  /// scene and settings goes on from there to the same bits. False: there are no checkpoints of it.
  virtual bool persist(StateStream&) { return false; }
};

/// `scene` outlives the integrator.
using MakeIntegrator = std::unique_ptr<Integrator>(ParamReader&, const Scene&, const RenderSettings&);
struct IntegratorPlugin : Plugin<MakeIntegrator> {
  int frames_together = kMaxFrames;  // in one scene; 1 for an integrator that knows nothing of sharing
};
PluginTable<IntegratorPlugin>& integrator_plugins();

}  // namespace dspm
