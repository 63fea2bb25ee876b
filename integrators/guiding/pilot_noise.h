// Measures by pilot paths which noise an iteration's camera paths and photons leave, and what they cost.
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/guiding/pilot_pixels.h"
#include "dspm/integrators/guiding/visible_points.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// What two camera paths per pilot pixel see, and the work of one.
struct PilotSight {
  std::vector<double> light[2];     // luminances by pilot pixel and frame
  std::vector<HitPointTile> tiles;  // of the first
  double rays = 0, hit_points = 0, radius_in_pixels = 0;
};

/// What photons of pilot paths bring to the hit points of pilot pixels, and the work of one path.
struct PilotGathers {
  double variance = 0;  // of one path an iteration, at the later radius, relative to brightness
  double seen = 0;      // the variance of camera paths that find what the photons bring
  double segments = 0;
  double found = 0;        // times that a hit point of any pixel gathers one of its photons
  double found_share = 0;  // of the paths
};

class NoisePilot {
 public:
  /// The radius of photons' gathers, over the initial one: that after 64 iterations.
  static constexpr double kLaterRadius = 0.55;

  /// Pilots are `paths` photon paths, in few frames of a scene whose frames stand for the file.
  NoisePilot(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
             const HitPointSettings& hit_point, std::int64_t paths);

  /// The settings that pilots of an iteration with the given settings are traced with.
  const PhotonSettings& photon() const { return photon_; }
  const HitPointSettings& hit_point() const { return hit_point_; }

  /// Lets errors count relative to the brightness of all light: what camera paths see and, unless `photon` is null, what
  /// such photons bring besides.
  void weigh(const HitPointSettings& hit_point, const DirectBalance* direct, const PhotonSettings* photon,
             const EmissionGuides& guides);

  PilotSight see(const HitPointSettings& hit_point, const DirectBalance* direct) const;
  /// Returns the mean variance of what one camera path per pixel sees, relative to brightness.
  double noise_of(const PilotSight& sight) const;
  PilotGathers gathers(const PilotSight& sight, const PhotonSettings& photon, const EmissionGuides& guides) const;

 private:
  /// The hit points of pilot pixels: ordinary ones, and those of glossy lobes.
  struct Gathering {
    VisiblePoints matte, glossy;
  };
  Gathering gathering(const PilotSight& sight) const;
  PilotSight see(HitPointSettings hit_point, const DirectBalance* direct, std::uint64_t iteration) const;
  std::vector<PhotonTrace> photons(PhotonSettings photon, const EmissionGuides& guides, std::uint64_t iteration) const;
  void add_brought(const PilotSight& sight, const PhotonSettings& photon, const EmissionGuides& guides,
                   std::vector<double>& light) const;
  std::vector<double> with_neighbours(const std::vector<double>& light) const;

  std::size_t index(int pixel, Frame f) const {
    return static_cast<std::size_t>(pixels_.index(pixel)) * frames() + static_cast<std::size_t>(f);
  }
  std::size_t frames() const { return static_cast<std::size_t>(scene_.frame_count()); }
  std::size_t pilot_pixels() const { return static_cast<std::size_t>(pixels_.columns() * pixels_.rows()); }
  /// Scales search radii: pilot pixels are further apart than pixels.
  float scale() const { return std::max(1.f, 0.5f * static_cast<float>(pixels_.stride)); }

  const Scene& scene_;
  PilotPixels pixels_;
  PhotonSettings photon_;
  HitPointSettings hit_point_;
  std::int64_t paths_;
  double full_;                  // pixels
  std::vector<double> weights_;  // of errors squared, by pilot pixel and frame
};

}  // namespace dspm
