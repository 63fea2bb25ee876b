// Writes what photon paths leave in a trace: photons where lobes gather, and hidden ones where glossy lobes may.
#pragma once

#include <cmath>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/transport/direct_light.h"
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

/// Where a path has started.
struct PhotonOrigin {
  const SceneLight& light;
  const Light& state;
  LightStart start;
  float must_reach;
  int index;       // of the light
  float radiance;  // its luminance, if wanted; for a delta light, see Emission
  bool has_place;  // of a delta light: it has a place, from which irradiance falls off
};

/// Returns the radiance with which it leaves the light; for a delta light, see Emission.
inline Rgb radiance_of(const Emission& emission) {
  const float cosine = length2(emission.normal) > 0 ? std::abs(dot(emission.normal, emission.ray.direction)) : 1;
  return emission.flux * (emission.pdf.position * emission.pdf.direction / cosine);
}

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

 private:
  bool gathers(const Vertex& vertex, const Bsdf& bsdf) const {
    return gathering_lobes(bsdf, vertex.point, settings_.least_alpha) != 0;
  }
  bool is_wanted(const PhotonPath& path, const PhotonOrigin& from) const {
    if (path.kind == kDirectPhotons && settings_.rays_tell && is_told_by_a_ray(scene_, from.light)) return false;
    return (path.kind & settings_.kinds) != 0;
  }
  /// Excludes light straight from the light source, which shadow rays find.
  bool is_hidden_on(const PhotonPath& path, const Vertex& vertex, const Bsdf& bsdf) const {
    return path.hidden && path.bounces > 0 && glossy_lobes(bsdf, vertex.point, settings_.least_alpha) != 0;
  }

  void store(std::vector<Photon>& photons, const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex,
             FrameSet frames) {
    const SurfacePoint& point = vertex.point;
    const Vec3& wi = vertex.wo;
    Rgb flux = path.throughput;
    if (const Vec3& ns = unbent_normal(point); !(ns == point.ng)) {
      // If the normals disagree about the side, every scattering function is zero.
      const float geometric = dot(wi, point.ng), shading = dot(wi, ns);
      if (!(geometric * shading > 0)) return;
      flux *= shading / geometric;
    }
    if (path.kind == kDirectPhotons && settings_.direct != nullptr)
      flux *= settings_.direct->weight_of_photon(from.light, from.state, from.start, {point.p, point.ng});
    photons.push_back(photon(path, from, vertex, flux, frames));
    count(photons.back());
    if (settings_.keep_seen && &photons == &trace_.photons) trace_.seen.push_back(path.seen);
  }

  void store_on_curve(const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex, FrameSet frames) {
    trace_.on_curves.push_back({photon(path, from, vertex, path.throughput, frames),
                                StripPlace(vertex.shape, vertex.hit, vertex.wo), path.bounces});
    count(trace_.on_curves.back());
  }

  Photon photon(const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex, Rgb flux, FrameSet frames) {
    const StrandList strands = trace_.strands.folded(path.strands, frames, flux);
    const ShapeFace face(vertex.hit.shape, vertex.point.ng, vertex.wo);
    return {vertex.point.p, face, vertex.wo, flux, frames, strands, from.index};
  }

  void count(const Photon& stored) {
    trace_.stored.add(stored.frames.count());
    trace_.paths.weighted += stored.strands != 0;
  }

  const Scene& scene_;
  const PhotonSettings& settings_;
  PhotonTrace& trace_;
};

}  // namespace dspm
