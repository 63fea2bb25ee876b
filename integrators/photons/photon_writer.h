// Writes what photon paths leave in a trace: photons where lobes gather, and hidden ones where glossy lobes may.
#pragma once

#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/transport/lobe_choice.h"
#include "dspm/integrators/transport/mixed_frames.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct PhotonPath : PathState {
  unsigned kind = kDirectPhotons;
  int start = 0;         // index into the starts of this path
  float seen = 0;        // see PhotonTrace
  bool hidden = false;   // see PhotonTrace::hidden
  bool caustics = true;  // see SceneLight
};

/// The luminance that leaves a light along a path; of a delta light, see Emission, and whether irradiance falls off.
struct LightSeen {
  float radiance = 0;
  bool has_place = false;
};

/// Where a path has started.
struct PhotonOrigin {
  const SceneLight& light;
  const Light& state;
  LightStart start;
  float must_reach;
  int index;  // of the light
  LightSeen seen;
  Rgb flux;  // of what the light emitted
};

class PhotonWriter {
 public:
  PhotonWriter(const Scene& scene, const PhotonSettings& settings, PhotonTrace& trace)
      : scene_(scene), settings_(settings), trace_(trace) {}

  /// The frames in which the surface gathers, or may gather right beside the point.
  struct Stored {
    FrameSet gathering, hidden;
  };
  Stored stored_on_mixes(const PhotonPath& path, const Vertex& vertex) const {
    return {mixed_frames(vertex, [&](const Bsdf& bsdf) { return gathers(vertex, bsdf); }),
            mixed_frames(vertex, [&](const Bsdf& bsdf) { return is_hidden_on(path, vertex, bsdf); })};
  }
  void add(Stored& stored, const PhotonPath& path, const Vertex& vertex, FrameSet frames, const Bsdf& bsdf) const {
    if (gathers(vertex, bsdf)) stored.gathering |= frames;
    if (is_hidden_on(path, vertex, bsdf)) stored.hidden |= frames;
  }
  void store(const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex, const Stored& stored) {
    if (!stored.gathering.empty() && is_wanted(path, from)) store(trace_.photons, path, from, vertex, stored.gathering);
    if (stored.hidden.empty()) return;
    if (vertex.point.turns)
      store_on_curve(path, from, vertex, stored.hidden);
    else
      store(trace_.hidden, path, from, vertex, stored.hidden);
  }

  /// Stores what is scattered there, in each of the medium's states.
  void store_in_medium(const PhotonPath& path, const PhotonOrigin& from, const MediumVertex& vertex);

 private:
  bool gathers(const Vertex& vertex, const Bsdf& bsdf) const {
    return gathering_lobes(bsdf, vertex.point, settings_.least_alpha) != 0;
  }
  bool is_wanted(const PhotonPath& path, const PhotonOrigin& from) const;
  /// Excludes light straight from the light source, which shadow rays find.
  bool is_hidden_on(const PhotonPath& path, const Vertex& vertex, const Bsdf& bsdf) const {
    return path.hidden && path.bounces > 0 && glossy_lobes(bsdf, vertex.point, settings_.least_alpha) != 0;
  }

  void store(std::vector<Photon>& photons, const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex,
             FrameSet frames);
  void store_on_curve(const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex, FrameSet frames);
  Photon photon(const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex, Spectrum flux, FrameSet frames);
  void count(const Photon& stored);

  const Scene& scene_;
  const PhotonSettings& settings_;
  PhotonTrace& trace_;
};

}  // namespace dspm
