// Segments of camera paths in media: what they see is the light that photons along them scatter towards the camera. [Jarosz,
// Zwicker and Jensen 2008, The Beam Radiance Estimate]
#pragma once

#include <algorithm>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/integrators/transport/strand.h"

namespace dspm {

struct CameraBeam {
  Ray ray;                   // from the camera path's last vertex or boundary
  float begin = 0, end = 0;  // the part of it, in one state of the medium
  Spectrum throughput;       // where the ray begins
  FrameSet frames;
  StrandList strands = 0;  // in the tile's table
  int pixel = 0;
  bool caught = false;
  bool is_alone = false;                    // as in HitPoint
  bool of_media = false;                    // as in SeenLight
  int medium = -1;                          // into the scene's
  float radius = 0;                         // initial, where the ray begins: see HitPoint
  float spread = 0;                         // added to it per unit of length
  float least = 0, most = 0;                // what it is kept within
  Spectrum left;                            // of light that has come from `begin` to the ray's origin
  Spectrum sigma_t;                         // if the medium is the same everywhere; else black
  std::uint32_t first_step = 0, steps = 0;  // of the tile's, if it varies: see MediumSection

  float radius_at(float t) const { return std::clamp(std::abs(radius + spread * t), least, most); }
};

}  // namespace dspm
