// Traces the paths of iterations: one by one, or in waves if there is a tracer for these and if the scene and the settings
// allow it. What paths leave is the same.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/colour/palette.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/photon_map.h"
#include "dspm/integrators/photons/point_flux.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class MachineFailure;
class PlainObjects;
class WaveTracer;

class TracedPaths {
 public:
  /// Without a tracer, all paths are traced one by one. `goes_on`: if the tracer fails, the CPU traces what it has not; else MachineFailure is thrown.
  TracedPaths(std::unique_ptr<WaveTracer> tracer, bool goes_on);
  /// The same by the tracer of a device.
  TracedPaths(Device device, bool goes_on);
  ~TracedPaths();

  /// Does what trace_photons() does.
  std::vector<PhotonTrace> photons(const Scene& scene, const PhotonSettings& settings, std::uint64_t iteration,
                                   std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse);
  /// Does what trace_hit_points() does, for every pixel.
  std::vector<HitPointTile> hit_points(const Scene& scene, const RenderSettings& render,
                                       const HitPointSettings& settings, std::uint64_t iteration,
                                       std::vector<HitPointTile> reuse);

  /// Returns the flux of the photons within radius2_of(hit point), squared, of each of the tiles' hit points; nullopt if no
  /// tracer gathers it.
  std::optional<FluxOfPoints> flux(const Scene& scene, std::span<const HitPointTile> tiles, const PhotonMap& photons,
                                   const std::function<float(const HitPoint&)>& radius2_of);

  /// Returns why paths have left the GPU; empty: they have not.
  const std::string& why_off_gpu() const { return why_off_gpu_; }

 private:
  /// Sees to it that the tracer has the scene; returns false if the scene is not plain.
  bool load(const Scene& scene);
  void leave_gpu(const MachineFailure& failure);
  /// Loads the scene and calls in_waves(), again with fewer paths at once if memory does not suffice. Returns false if the
  /// scene is not plain, or if the tracer fails: it is left.
  template <class InWaves>
  bool attempt(const Scene& scene, const InWaves& in_waves);

  std::unique_ptr<WaveTracer> tracer_;  // null: one by one
  bool goes_on_;
  std::string why_off_gpu_;
  std::unique_ptr<const PlainObjects> plain_;  // null: the scene is not
  const Accel* accel_ = nullptr;               // of the scene that is loaded, or is not plain
  std::shared_ptr<const Palette> palette_;     // that its materials have
};

}  // namespace dspm
