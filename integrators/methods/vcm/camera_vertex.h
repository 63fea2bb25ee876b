// A vertex of a camera subpath, as light subpaths are connected to it and merged with it, and what they bring.
#pragma once

#include <span>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/rng.h"
#include "dspm/integrators/methods/vcm/subpath_weights.h"
#include "dspm/integrators/transport/path_step.h"

namespace dspm {

/// `Place` is a Vertex or a MediumVertex.
template <class Place>
struct CameraVertex {
  const Place& place;
  std::span<const Surface> surfaces;  // those that can be connected
  FrameSet frames;
  int bounces;
  Inside inside;      // of the segment before
  PathRandom random;  // the path's
  SubpathWeights weights;
  bool is_alone;  // the path has one wavelength alone
};

/// Light that comes along one way, in some frames. `strands` are the light subpath's, still to be multiplied.
struct Brought {
  FrameSet frames;
  Spectrum radiance;
  const Strand* strands;
  int light;  // into the scene's
};

}  // namespace dspm
