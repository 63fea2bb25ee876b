// Hit points as values: where camera paths end and look for photons, in which frames. trace_hit_points.h makes them, and
// gather.h reads them. [WG12 4.1]
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/shape_face.h"
#include "dspm/integrators/transport/strand.h"

namespace dspm {

struct HitPoint {
  Vec3 p;
  Vec3 ng;  // on the camera path's side
  Spectrum
      throughput;  // of the path, divided by the probability that it ended here; times f if there is no `scattering`
  ShapeFace face;  // the one that the camera path has reached
  FrameSet frames;
  float radius;                // initial: the scene's, or from the pixel's footprint
  int pixel;                   // within the crop, row by row
  bool indirect = false;       // the path has left another hit point before
  bool caught = false;         // its first surface is a shadow catcher
  Wavelength wavelength = {};  // of the path
  int scattering = -1;         // index in the tile; negative if f is constant
  StrandList strands = 0;      // in the tile's table: factors to the throughput by frame, if they differ
};

/// Returns the area of the disc in which a hit point finds photons, times the number of photon paths. [WG12 (5)]
inline float kernel_size(float radius2, float paths = 1) { return paths * kPi * radius2; }

}  // namespace dspm
