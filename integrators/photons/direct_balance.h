// Direct light that photons, shadow rays and scattered rays bring to a hit point: each way is weighted by how well it
// finds the path from the light. [Georgiev et al. 2012; Hachisuka et al. 2012; Veach 1997, 9.2]
#pragma once

#include <cstdint>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The figures that weights depend on besides the scene.
struct DirectWays {
  std::int64_t photons = 0;                // paths of an iteration; 0: photons bring no direct light
  const EmissionGuides* guides = nullptr;  // they are drawn with; null or off: by power
  float radius = 0;                        // of a typical hit point in this iteration
  float photons_a_ray = 1;  // the photons that are as good as one ray: the inverse of its relative variance
  bool scatters = false;    // scattered rays look for lights even if none is infinite, as they are traced anyway
};

/// The weights of the ways, which add up to 1 for every path. They may be any functions of the path, so a photon
/// carries its weight in its flux: all hit points count as having the same radius, and as scattering like a matte
/// surface.
class DirectBalance {
 public:
  DirectBalance(const Scene& scene, const DirectWays& ways);

  /// Returns whether scattered rays look for lights: they are good at finding a sky.
  bool scatters() const { return scatters_; }

  /// A point where light arrives.
  struct Place {
    Vec3 p, ng;
  };

  /// Returns the weight of a photon that has come straight from the light.
  float weight_of_photon(const SceneLight& light, const Light& state, const LightStart& start,
                         const Place& place) const;
  /// Returns the weight of a sample that sample_direct_light() takes of the light.
  float weight_of_sample(const LightSample& sample, const Place& place) const;
  /// Returns the weight of a ray, scattered at the place, that meets the light.
  float weight_of_scattered(const SceneLight& light, const Light& state, const LightStart& start,
                            const Place& place) const;

 private:
  /// Densities by solid angle at the place, in photons; plain numbers for a delta light.
  struct Densities {
    float photons, samples, scattered;
    float all() const { return photons + samples + scattered; }
    bool enough_photons() const;
  };
  Densities densities(const SceneLight& light, const Light& state, const LightStart& start, const Place& place,
                      float sample_pdf_w) const;

  const Scene& scene_;
  const EmissionGuides* guides_;
  float photons_times_area_;  // of a typical kernel
  float photons_a_ray_;
  bool scatters_;
};

}  // namespace dspm
