// Traces photons from the lights, for all frames at once; their paths split where frames part, and leave a photon
// wherever a camera path can gather it. [WG12 4.2]
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/rng.h"
#include "dspm/integrators/photons/curve_photons.h"
#include "dspm/integrators/photons/medium_photons.h"
#include "dspm/integrators/photons/photon.h"
#include "dspm/integrators/photons/photon_kinds.h"
#include "dspm/integrators/photons/photon_numbers.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/transport/strand.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class DirectBalance;
struct EmissionGuides;

struct PhotonSettings {
  std::uint64_t seed = 0;
  bool independent_numbers = false;  // as in RenderSettings
  Stream stream = Stream::photon;
  int max_depth = 8;             // a photon is stored at its first max_depth hits
  float least_alpha = 0.25f;     // lobes smoother than this do not gather: no photon is stored just for them
  unsigned kinds = kAllPhotons;  // to be stored
  bool hidden = false;           // also store hidden photons
  bool share_paths = false;      // frames that differ only in appearance or light share paths; else they part
  FrameSet frames = FrameSet::first(kMaxFrames);  // in which paths are traced
  const EmissionGuides* guides = nullptr;
  const DirectBalance* direct = nullptr;  // weights photons that come straight from a light; null: 1
  bool rays_tell = false;                 // no direct photons of lights that is_told_by_a_ray() are stored
  bool rays_light_media = false;          // no direct photons are stored in media
  float flux = 1;                         // what that of every path is multiplied by
  bool own_wavelengths = false;           // paths have wavelengths of their own, and photons have their hues
  bool keep_ends = false;                 // the traces say which photons are of which path
  bool keep_seen = false;                 // the traces say what rays see along the photons, see PhotonTrace::seen
  std::int64_t paths_per_trace = 2048;    // one thread traces them; fewer than these are better shared out
  bool are_light_paths = false;           // reports call them so: what they bring needs no hit points that merge it
};

/// The results of a range of photon paths.
struct PhotonTrace {
  std::vector<Photon> photons;  // by path index, then branch; a frame's photons of one path by bounce
  // Photons on glossy lobes whose light no camera path finds: it left a light that no ray can hit and met only specular
  // lobes. In the same order.
  std::vector<Photon> hidden;
  std::vector<CurvePhoton> on_curves;  // likewise, on surfaces that turn
  std::vector<MediumPhoton> in_media;
  struct End {
    std::size_t photons, hidden, on_curves, in_media;
  };
  std::vector<End> ends;  // of each path in these lists, if they are kept
  /// Of each of `photons`, if kept: the luminance that a camera path sees if it finds its way to the light along this
  /// path, weighted as beside a shadow ray from where the photon was scattered first; 0 for direct photons.
  std::vector<float> seen;
  StrandTable strands;
  StrandList own_strands = 1;  // earlier lists belong to the lights and are the same in all traces
  PathCounts paths;
  SharedCount stored;
  std::vector<EnergyBalance> energy;  // by frame
  std::int16_t only_nm = 0;           // of photons that lack their hue, see Photon
  Rejections rejections;
};

inline PathRandom numbers_of(const PhotonSettings& settings, std::uint64_t path_index, std::uint64_t iteration) {
  return photon_numbers(settings.seed, settings.stream, path_index, iteration, settings.independent_numbers);
}

/// Adds the traces' counts to `statistics`.
void account(const std::vector<PhotonTrace>& traces, Statistics& statistics);
std::size_t bytes_of(const std::vector<PhotonTrace>& traces);
/// Empties the trace but keeps the memory; its first strands are those of lights.
void clear(PhotonTrace& trace, const StrandTable& of_lights);

/// Traces paths first .. end - 1 of an iteration in parallel; returns chunks of paths in order. Recycles the buffers in
/// `reuse` to avoid allocations.
std::vector<PhotonTrace> trace_photons(const Scene& scene, const PhotonSettings& settings, std::uint64_t iteration,
                                       std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse);

}  // namespace dspm
