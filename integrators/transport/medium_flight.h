// The flight of a path through a medium up to a collision or a surface. Its lengths are drawn for one colour, the same for
// the whole path; a colour's weight is its own density over the mean of all three, at most 3. [Wilkie et al. 2014, Hero
// Wavelength Spectral Sampling; Miller, Georgiev and Jarosz 2019, A Null-Scattering Path Integral Formulation]
#pragma once

#include <cstddef>
#include <span>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/medium_boundary.h"
#include "dspm/integrators/transport/medium_vertex.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The frames of a path that have met the same on their flight so far.
struct Flying {
  FrameSet frames;
  const Medium* medium;
  Spectrum weight{1};  // of the path's throughput
  Spectrum share;      // see Flights

  /// Weights the colours by their densities of what has been drawn. Returns false if nothing is left.
  bool weigh(const Spectrum& density);
};

class MediumFlight {
 public:
  /// The path is in a medium, which has these majorants in the path's `frames`.
  MediumFlight(const Scene& scene, const PathState& path, FrameSet frames, const Majorants& majorants);

  /// A state's collision, and how the medium scatters there.
  struct Colliding {
    Flying flown;
    Spectrum albedo;
    float g;
  };

  /// Flies on to the next tentative collision, up to `distance` at most. Returns whether there was one: colliding() are
  /// then the frames in which it was none in name only, which fly no more, and glowing() is what the medium has added.
  bool meet(float distance);
  float distance() const { return collisions_.distance(); }
  const Spectrum& majorant() const { return collisions_.majorant(); }  // there
  std::span<const Colliding> colliding() const { return colliding_; }
  /// The radiance, or the flux, that the medium has added for each unit of the path's throughput.
  std::span<const FrameFactor> glowing() const { return glowing_; }

  std::span<const Flying> flying() const { return flying_; }
  /// Takes out these frames, which have met a surface.
  void land(FrameSet frames);
  int numbers() const { return numbers_; }

 private:
  const PathState& path_;
  const int colour_;
  int numbers_;
  const Palette& palette_;
  TentativeCollisions collisions_;
  FrameArray<Flying> flying_;
  FrameArray<Colliding> colliding_;
  FrameArray<FrameFactor> glowing_;
};

}  // namespace dspm
