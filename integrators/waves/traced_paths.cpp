#include "dspm/integrators/waves/traced_paths.h"

#include <utility>

#include "dspm/integrators/waves/devices.h"
#include "dspm/integrators/waves/machine.h"
#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/integrators/waves/wave_flux.h"
#include "dspm/integrators/waves/wave_hit_points.h"
#include "dspm/integrators/waves/wave_photons.h"
#include "dspm/integrators/waves/wave_tracer.h"

namespace dspm {
namespace {

template <class Settings>
bool may_take_waves(const WaveTracer* tracer, const Scene& scene, const Settings& settings) {
  return tracer != nullptr && why_not_by_settings(scene, settings).empty();
}

}  // namespace

TracedPaths::TracedPaths(std::unique_ptr<WaveTracer> tracer, bool goes_on)
    : tracer_(std::move(tracer)), goes_on_(goes_on) {}

TracedPaths::TracedPaths(Device device, bool goes_on) : goes_on_(goes_on) {
  try {
    tracer_ = tracer_on(device);
  } catch (const MachineFailure& failure) {
    leave_gpu(failure);
  }
}

TracedPaths::~TracedPaths() = default;

std::vector<PhotonTrace> TracedPaths::photons(const Scene& scene, const PhotonSettings& settings,
                                              std::uint64_t iteration, std::int64_t first, std::int64_t end,
                                              std::vector<PhotonTrace> reuse) {
  if (may_take_waves(tracer_.get(), scene, settings) && attempt(scene, [&] {
        reuse = trace_photons_in_waves(scene, *tracer_, settings, iteration, first, end, std::move(reuse));
      }))
    return reuse;
  return trace_photons(scene, settings, iteration, first, end, std::move(reuse));
}

std::vector<HitPointTile> TracedPaths::hit_points(const Scene& scene, const RenderSettings& render,
                                                  const HitPointSettings& settings, std::uint64_t iteration,
                                                  std::vector<HitPointTile> reuse) {
  if (may_take_waves(tracer_.get(), scene, settings) && attempt(scene, [&] {
        reuse =
            trace_hit_points_in_waves(scene, plain_->scene(), *tracer_, render, settings, iteration, std::move(reuse));
      }))
    return reuse;
  return trace_hit_points(scene, render, settings, iteration, std::move(reuse));
}

std::optional<FluxOfPoints> TracedPaths::flux(const Scene& scene, std::span<const HitPointTile> tiles,
                                              const PhotonMap& photons,
                                              const std::function<float(const HitPoint&)>& radius2_of) {
  std::optional<FluxOfPoints> flux;
  if (tracer_ != nullptr)
    attempt(scene, [&] {
      if (may_gather_in_waves(tiles, photons, plain_->scene()))
        flux = gather_in_waves(*tracer_, tiles, photons, radius2_of);
    });
  return flux;
}

template <class InWaves>
bool TracedPaths::attempt(const Scene& scene, const InWaves& in_waves) {
  for (;;) try {
      if (!load(scene)) return false;
      in_waves();
      return true;
    } catch (const OutOfMachineMemory& failure) {
      if (!tracer_->take_fewer()) return leave_gpu(failure), false;
    } catch (const MachineFailure& failure) {
      return leave_gpu(failure), false;
    }
}

// A scene whose shutter is open is not plain, so all iterations have one accelerator.
// A scene whose shutter is open is not plain, so all iterations have one accelerator.
bool TracedPaths::load(const Scene& scene) {
  if (accel_ == scene.accel.get() && palette_ == scene.palette) return plain_ != nullptr;
  accel_ = nullptr, plain_.reset();
  if (why_not_plain(scene).empty()) {
    plain_ = std::make_unique<const PlainObjects>(scene);
    tracer_->load(plain_->scene());
  }
  accel_ = scene.accel.get(), palette_ = scene.palette;
  return plain_ != nullptr;
}

void TracedPaths::leave_gpu(const MachineFailure& failure) {
  if (!goes_on_) throw failure;
  why_off_gpu_ = failure.what();
  tracer_.reset(), plain_.reset(), accel_ = nullptr;
}

}  // namespace dspm
