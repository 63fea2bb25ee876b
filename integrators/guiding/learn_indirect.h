// Learns how much of the light photons should bring: all of it, caustics only, or none. Photons need a surface full of
// them, and find their way well in a room; under a sky over a wide ground hardly one does. Camera paths find all light but
// what point, spot and distant lights send through specular lobes; other caustics cost them noise.
#pragma once

#include <cstdint>
#include <memory>

#include "dspm/integrators/emission_report.h"
#include "dspm/integrators/guiding/learn_direct.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/possible_caustics.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// A way to find all light: what photons bring, how many an iteration traces, and the noise at equal work, which is its
/// merit: the product of an iteration's work and variance.
struct LightWay {
  PhotonsBring bring = PhotonsBring::all;
  std::int64_t photons = 0;
  double merit = 0;
};

/// Measures ways by pilot paths in a scene whose frames stand for the file. An iteration traces at most `photons` paths;
/// those of caustics are drawn with the given guides.
class LightWays {
 public:
  LightWays(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
            const HitPointSettings& hit_point, std::int64_t photons, PossibleCaustics caustics,
            const EmissionGuides& of_caustics);
  ~LightWays();

  /// Returns the best of the ways that leave at most caustics to photons.
  LightWay by_camera_paths() const;
  /// Returns the way by photons that are drawn with those guides.
  LightWay by_photons(const EmissionGuides& guides, const LearnedDirect& direct) const;
  /// Returns what by_photons() may reach if a guide spares all pilot paths that are not found.
  LightWay by_photons_at_best(const LearnedDirect& direct) const;

 private:
  class Pilot;
  std::unique_ptr<Pilot> pilot_;
};

}  // namespace dspm
