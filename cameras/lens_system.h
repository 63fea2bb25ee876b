// A lens as it is built: spherical surfaces and a stop on one axis.
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/diaphragm.h"

namespace dspm {

/// One surface of a lens, with lengths in metres. Lists of surfaces go from the scene to the film.
struct LensSurface {
  float curvature = 0;  // radius; above 0: the surface bulges towards the scene; 0: a stop
  float thickness = 0;  // to the next surface, or from the last one to the film
  float eta = 1;        // index of what follows; 0 is air, too
  float aperture = 0;   // radius of what light may pass
  friend bool operator==(const LensSurface&, const LensSurface&) = default;
};

/// The film lies in the plane z = 0 and looks along +z, where the scene is.
class LensSystem {
 public:
  /// Takes at least one surface. The diaphragm is that of all stops.
  explicit LensSystem(std::vector<LensSurface> surfaces, Diaphragm diaphragm = {});

  /// A ray that has left the lens for the scene, of unit length, and the share of its light that the stop lets through.
  struct Passage {
    Ray ray;
    float share = 1;
  };
  /// Returns nullopt if the ray, from the film into any direction, does not pass.
  std::optional<Passage> from_film(const Ray& ray) const;
  /// Traces a ray that starts before the lens back to the film. Stops let it through within their circles.
  std::optional<Ray> from_scene(const Ray& ray) const;

  float front_z() const { return z_.front(); }
  float rear_z() const { return z_.back(); }
  float rear_aperture() const { return surfaces_.back().aperture; }
  /// Returns the same lens with a round stop that is as wide as its shape reaches.
  LensSystem with_round_stop() const;

  /// The thick lens that acts as this one does near the axis.
  struct ThickLens {
    float focal_length;                     // below 0: it scatters
    float scene_principal, film_principal;  // where its principal planes lie, as z
  };
  /// Returns nullopt if a ray beside the axis does not pass, or is not bent.
  std::optional<ThickLens> thick_lens() const;

  /// Moves the lens so that a plane at that distance before the film is sharp, by the equation of the thick lens, and
  /// returns the distance from the film to the principal plane. Throws std::runtime_error with a sentence if it cannot.
  float focus(float distance);

 private:
  void set_film_distance(float distance);

  std::vector<LensSurface> surfaces_;
  std::vector<float> z_;  // of their vertices
  Diaphragm diaphragm_;
};

}  // namespace dspm
