// Photons: traced from the lights for all frames at once, split where frames part, stored where a camera path could
// gather them. [WG12 4.2]
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/strand.h"
#include "dspm/math/frames.h"
#include "dspm/math/rng.h"
#include "dspm/math/vec.h"
#include "dspm/scene/scene.h"

namespace dspm {

struct Photon {
  Vec3 p;
  Vec3 wi;   // towards where it came from, unit length
  Rgb flux;  // in W; already holds |cos(wi, ns) / cos(wi, ng)| of its surface, so that a gather needs no cosine
  FrameSet frames;
  StrandList strands = 0;  // in its trace's table: what frames have times the flux, where they differ
};

/// Photons by what happened to them before they are stored.
enum PhotonKinds : unsigned {
  kDirectPhotons = 1,   // nothing: they come straight from the light
  kCausticPhotons = 2,  // scattered, by lobes smoother than least_alpha only
  kDiffusePhotons = 4,  // scattered by a rougher lobe at least once
  kAllPhotons = 7,
};

struct PhotonSettings {
  std::uint64_t seed = 0;
  Stream stream = Stream::photon;
  int max_depth = 8;             // a photon is stored at its first max_depth hits
  float least_alpha = 0.25f;     // lobes smoother than this do not gather: nothing is stored for them alone
  unsigned kinds = kAllPhotons;  // those that are stored
  bool hidden = false;           // hidden photons are stored, too
  bool share_paths = false;      // frames that differ in looks or light only share paths; else they part
};

/// What a range of photon paths left behind.
struct PhotonTrace {
  std::vector<Photon> photons;  // by path index, then branch; a frame's photons of one path by bounce
  // Light that no camera path finds by following a glossy lobe, on such lobes: it left a light that no ray can hit and
  // met specular lobes only. In the same order.
  std::vector<Photon> hidden;
  StrandTable strands;
  StrandList own_strands = 1;  // earlier lists are the lights', the same in all traces
  PathCounts paths;
  SharedCount stored;
  std::vector<EnergyBalance> energy;  // by frame
  Rejections rejections;
};

/// Takes the traces' counts into `statistics`.
void account(const std::vector<PhotonTrace>& traces, Statistics& statistics);
std::size_t bytes_of(const std::vector<PhotonTrace>& traces);

/// Traces paths first .. end - 1 of an iteration, in parallel; chunks of paths in their order. The buffers in `reuse`
/// are taken over to spare allocations.
std::vector<PhotonTrace> trace_photons(const Scene& scene, const PhotonSettings& settings, std::uint64_t iteration,
                                       std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse);

}  // namespace dspm
