// One step of a wave of photon paths: what trace_photons.h does between two surfaces, for all paths at once, one bounce
// after the other. The step is a function of one path's state and of plain values, and leaves all that it makes to `out`:
// so a device can take it as it stands.
#pragma once

#include <algorithm>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"
#include "dspm/integrators/photons/arrival_correction.h"
#include "dspm/integrators/photons/photon_kinds.h"
#include "dspm/integrators/transport/gathering_lobes.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/roulette_chance.h"
#include "dspm/integrators/transport/sample_bsdf.h"
#include "dspm/integrators/transport/shading_correction.h"
#include "dspm/integrators/transport/shape_face.h"
#include "dspm/integrators/waves/arrivals.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/integrators/waves/wave_order.h"

namespace dspm {

/// The settings that a step needs; see PhotonSettings.
struct PhotonWave {
  int max_depth;
  float least_alpha;
  unsigned kinds;
  HuedWavelength wavelength;
};

/// A photon path on its way, with all that tells it from others.
struct PhotonState {
  Ray ray;
  Spectrum throughput;
  FrameSet frames;
  PathRandom random;
  float must_reach;     // the distance before which the first segment meets nothing that counts
  std::uint32_t start;  // the path's, among those of the wave
  std::uint32_t path;   // its number: lights chosen for some of the frames start paths of one number
  std::uint16_t bounces;
  std::uint8_t kind;
  bool hidden, caustics;
  bool alone;         // see Wavelength
  bool wants_direct;  // photons straight from its light are to be stored
  BodiesOfPath bodies;
};

/// A photon as a step leaves it.
struct WavePhoton {
  Vec3 p, ng, wi;
  Spectrum flux;
  FrameSet frames;
  ShapeFace face;
  std::uint32_t start, path;
  std::uint16_t bounces;
  std::uint8_t kind;
  bool hidden;  // see PhotonTrace::hidden
  bool alone;   // see Wavelength

  /// Photons in the order of these numbers, which differ, are in the order of path, bounce and frame.
  constexpr std::uint64_t order() const { return wave_order(path, bounces, frames, hidden); }
};

/// Where the flux of a path goes; see EnergyBalance.
enum class PhotonEnd : std::uint8_t { escaped, absorbed, terminated, too_deep };

/// A path that has arrived at a surface.
template <class Out>
class PhotonAtSurface {
 public:
  constexpr PhotonAtSurface(const PhotonWave& wave, const PhotonState& path, const Arrival& at, Out& out)
      : wave_(wave), path_(path), at_(at), point_(at.point), wo_(-path.ray.direction), out_(out) {}

  /// Says in which frames the next calls are.
  constexpr void take(FrameSet frames) { path_.frames = frames; }
  /// Sees whether photons are to be stored, by a Bsdf at the point or one that may be beside it.
  template <class AnyBsdf>
  constexpr void look(const AnyBsdf& bsdf) {
    if (gathering_lobes(bsdf, point_, wave_.least_alpha) != 0) gathering_ |= path_.frames;
    const bool may_hide = path_.hidden && path_.bounces > 0;
    if (may_hide && glossy_lobes(bsdf, point_, wave_.least_alpha) != 0) hidden_ |= path_.frames;
  }
  constexpr void store() {
    const bool is_wanted = path_.kind == kDirectPhotons ? path_.wants_direct : (path_.kind & wave_.kinds) != 0;
    if (!gathering_.empty() && is_wanted) store(gathering_, false);
    if (!hidden_.empty()) store(hidden_, true);
  }
  template <class AnyBsdf>
  constexpr void scatter(const AnyBsdf& bsdf) {
    if (path_.bounces + 1 >= wave_.max_depth) return out_.end(path_, PhotonEnd::too_deep);
    const LobeChoice choice = choose_lobes(bsdf, point_, wo_, wave_.least_alpha, path_.random, path_.bounces);
    const unsigned kind = kind_after(path_.kind, choice.rough);
    const bool wanted =
        kind == kDiffusePhotons ? (wave_.kinds & kDiffusePhotons) != 0 : path_.caustics && at_.shape.caustics;
    if (!wanted) return out_.end(path_, PhotonEnd::terminated);
    const auto sample = sample_bsdf(bsdf, wo_, Transport::flux, choice.lobes, path_.random, path_.bounces);
    const bool valid = !sample || is_finite(sample->wi);
    if (!valid) out_.reject_material(path_, at_.shape.material);
    if (!sample || !valid) return out_.end(path_, PhotonEnd::absorbed);
    const float correction = shading_correction(point_, wo_, sample->wi);
    const Spectrum after = path_.throughput * (sample->weight * (correction / choice.chance));
    const Spectrum surviving = play_roulette(after);
    if (is_black(surviving)) return;
    PhotonState next = path_;
    next.ray = point_.spawn(sample->wi), next.throughput = surviving,
    next.bodies = bodies_beyond(path_.bodies, at_, wo_, sample->wi);
    next.kind = static_cast<std::uint8_t>(kind), next.hidden = path_.hidden && sample->specular;
    next.alone = path_.alone || sample->by_wavelength;
    ++next.bounces;
    out_.push(next);
  }

 private:
  constexpr void store(FrameSet frames, bool hidden) {
    const auto correction = arrival_correction(point_.ns, point_.ng, wo_);
    if (!correction) return;
    out_.store({point_.p, point_.ng, wo_, path_.throughput * *correction, frames,
                ShapeFace(at_.part.hit.shape, point_.ng, wo_), path_.start, path_.path, path_.bounces, path_.kind,
                hidden, path_.alone});
  }

  constexpr Spectrum play_roulette(const Spectrum& after) {
    const Spectrum& before = path_.throughput;
    if (!is_light(after)) {
      out_.reject_material(path_, at_.shape.material);
      out_.end(path_, PhotonEnd::terminated);
      return {};
    }
    const float p = std::min(1.f, max_component(after) / max_component(before));
    const float u = path_.random.number(path_.bounces, kRoulette);
    const Spectrum surviving = left_by_roulette(after, p, u);
    out_.scatter(path_.frames, before, after, surviving);
    return surviving;
  }

  const PhotonWave& wave_;
  PhotonState path_;
  const Arrival& at_;
  const SurfaceGeometry& point_;
  Vec3 wo_;
  Out& out_;
  FrameSet gathering_, hidden_;  // in which photons are to be stored
};

/// Takes the path to what it meets next. `out` has
///   void segment(const PhotonState&, const HitPartition&)         a ray was traced
///   void store(const WavePhoton&)                                 a photon to be stored
///   void push(const PhotonState&)                                 the path goes on, in the next wave
///   void end(const PhotonState&, PhotonEnd)                       its flux ends
///   void dim(FrameSet, before, after)                             what bodies leave of its flux
///   void scatter(FrameSet, before, after, surviving)              what a surface and roulette make of its flux
///   void reject_shape(const PhotonState&, int), reject_material(const PhotonState&, int)   values that are not finite
template <class Query, class Out>
constexpr void step(const PlainScene& scene, const Query& query, const PhotonWave& wave, const PhotonState& path,
                    Out& out) {
  struct Tracer {
    const PhotonWave& wave;
    Out& out;

    constexpr void escaped(const PhotonState& here, const FrameHit&) const { out.end(here, PhotonEnd::escaped); }
    constexpr void lost(const PhotonState& here, int shape) const {
      out.reject_shape(here, shape);
      out.end(here, PhotonEnd::absorbed);
    }
    constexpr void arrived(const PhotonState& here, const Arrival& at) const {
      if (here.bounces == 0 && at.part.hit.t < here.must_reach) return out.end(here, PhotonEnd::absorbed);
      PhotonAtSurface<Out> surface(wave, here, at, out);
      // Frames that differ in the material store one photon, and then part.
      for (bool looks = true, scatters = !at.differs;; looks = false, scatters = true) {
        at.for_each_state([&](FrameSet frames, const PlainMaterial& material) {
          surface.take(frames);
          material.with_all_beside(at.point, wave.wavelength.of_path(here.alone), [&](const auto& bsdf, bool is_there) {
            if (looks) surface.look(bsdf);
            if (!is_there || !scatters) return;
            if (looks) surface.store();
            surface.scatter(bsdf);
          });
        });
        if (scatters) return;
        surface.store();
      }
    }
  };
  for_each_arrival(scene, query, path, out, Tracer{wave, out});
}

}  // namespace dspm
