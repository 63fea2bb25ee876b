// An estimate of an integrator's memory before it allocates any, for runs with a memory bound.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>

#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The needs of an integrator, in bytes.
struct MemoryNeeds {
  std::size_t pixels = 0;      // sums and statistics, by pixel and frame
  std::size_t hit_points = 0;  // per iteration
  std::size_t photons = 0;     // those held at a time, including their map
  std::size_t learning = 0;    // where photons start: before any of these

  std::size_t total() const { return std::max(pixels + hit_points + photons, learning); }
};

/// Thrown if RenderSettings::memory does not suffice.
struct NotEnoughMemory : std::exception {
  MemoryNeeds least;  // the least that would suffice

  explicit NotEnoughMemory(const MemoryNeeds& needs) : least(needs) {}
  const char* what() const noexcept override { return "not enough memory"; }
};

/// Throws NotEnoughMemory if `needs` exceed `memory`; 0 means that there is no bound.
void expect_enough(std::size_t memory, const MemoryNeeds& needs);

/// Estimates the bytes of hit points from small samples of iteration 0, the same in every run.
std::size_t hit_point_bytes(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings);
/// Estimates the bytes per traced photon path, including the photon map, which tells these groups apart.
double bytes_a_photon_path(const Scene& scene, const PhotonSettings& settings, const LightGroups& groups);

}  // namespace dspm
