// One step of a wave of camera paths: what trace_hit_points.h does between two surfaces if only photons bring light to hit
// points, for all paths at once, one bounce after the other. Like that of photon_wave.h, the step is a function of one path's
// state and of plain values, so a device can take it as it stands. Lights have no plain form: the step says where paths may
// see them, and leaves what they show to who knows them.
#pragma once

#include <cstdint>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"
#include "dspm/integrators/transport/gathering_lobes.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/roulette_chance.h"
#include "dspm/integrators/transport/sample_bsdf.h"
#include "dspm/integrators/waves/arrivals.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/integrators/waves/wave_order.h"
#include "dspm/world/scene/inside.h"

namespace dspm {

/// The settings that a step needs; see HitPointSettings.
struct CameraWave {
  int max_depth;
  float least_alpha;
  bool keep_bsdf;
  bool may_hide_photons;
  HuedWavelength wavelength;
};

/// A camera path on its way, see CameraPath. What it stands for is not followed: no texture that is averaged may vary.
struct CameraState {
  Ray ray;
  Spectrum throughput;
  FrameSet frames;
  float eta_scale;
  float length;
  Vec3 from, from_ng;
  float pdf_w;
  PathRandom random;
  std::uint32_t start;  // the path's, among those of the wave
  std::uint32_t path;   // its number: the camera's states start paths of one number
  std::uint16_t bounces;
  bool caught;
  bool alone;  // see Wavelength
  BodiesOfPath bodies;
};

/// A hit point as a step leaves it.
struct WaveHitPoint {
  SurfaceGeometry point;
  Vec3 wo;
  Spectrum throughput;  // of the path, as HitPoint has it
  FrameSet frames;
  float length;  // of the path
  RayHit hit;
  std::uint32_t start;
  std::uint16_t bounces;
  LobeSet lobes;  // that gather
  bool constant;  // f is, and among the throughput
  bool glossy;    // the lobes extend the path as well, and gather hidden photons only
  bool caught;
  bool alone;     // see Wavelength
  Inside inside;  // of the path as it has arrived

  /// See WavePhoton::order().
  constexpr std::uint64_t order() const { return wave_order(start, bounces, frames, glossy); }
};

/// A place where the path may see lights, in the order in which it does.
struct WaveSight {
  enum class Kind : std::uint8_t {
    escape,    // it has met no surface
    emission,  // of the surface
    samples    // of lights, scattered by glossy lobes, which extend the path
  };
  CameraState path;  // that has arrived there
  FrameHit at;
  LobeChoice choice;
  Kind kind;

  /// See WavePhoton::order().
  constexpr std::uint64_t order() const {
    return wave_order(path.start, path.bounces, path.frames, static_cast<unsigned>(kind));
  }
};

/// A path that has met a surface.
template <class Out>
class CameraAtSurface {
 public:
  constexpr CameraAtSurface(const CameraWave& wave, const CameraState& path, const Arrival& at, Out& out)
      : wave_(wave), path_(path), at_(at), point_(at.point), wo_(-path.ray.direction), out_(out) {}

  template <class AnyBsdf>
  constexpr void arrive(const AnyBsdf& bsdf) {
    const LobeChoice choice = choose_lobes(bsdf, point_, wo_, wave_.least_alpha, path_.random, path_.bounces);
    if (choice.rough)
      end(bsdf, choice);
    else
      scatter(bsdf, choice);
  }

 private:
  template <class AnyBsdf>
  constexpr void end(const AnyBsdf& bsdf, const LobeChoice& choice) {
    std::optional<Spectrum> constant;
    if (!wave_.keep_bsdf) constant = constant_on_one_side(bsdf, choice.lobes);
    if (constant && is_black(*constant)) return;
    store((constant ? *constant : Spectrum(1)) / choice.chance, choice.lobes, constant.has_value(), false);
  }

  template <class AnyBsdf>
  constexpr void scatter(const AnyBsdf& bsdf, const LobeChoice& choice) {
    if ((choice.lobes & bsdf.lobes(kLeastRoughness)) != 0)
      out_.see({path_, at_.part, choice, WaveSight::Kind::samples});
    const auto glossy = static_cast<LobeSet>(choice.lobes & glossy_lobes(bsdf, point_, wave_.least_alpha));
    if (glossy != 0 && wave_.may_hide_photons) store(Spectrum(1 / choice.chance), glossy, false, true);
    const auto sample = sample_bsdf(bsdf, wo_, Transport::radiance, choice.lobes, path_.random, path_.bounces);
    if (!sample) return;
    if (!is_finite(sample->wi)) return out_.reject_material(path_, at_.shape.material);
    CameraState next = path_;
    next.eta_scale *= sample->eta_scale;
    const Spectrum after = if_light(path_.throughput * (sample->weight / choice.chance));
    next.throughput = left_by_roulette(after, roulette_chance(after, next.eta_scale, path_.bounces),
                                       path_.random.number(path_.bounces, kRoulette));
    if (is_black(next.throughput)) return;
    next.ray = point_.spawn(sample->wi);
    next.bodies = bodies_beyond(path_.bodies, at_, wo_, sample->wi);
    next.from = point_.p, next.from_ng = point_.ng, next.pdf_w = sample->specular ? 0 : sample->pdf_w;
    next.alone = path_.alone || sample->by_wavelength;
    ++next.bounces;
    out_.push(next);
  }

  constexpr void store(const Spectrum& factor, LobeSet lobes, bool constant, bool glossy) {
    const Spectrum throughput = if_light(path_.throughput * factor);
    if (is_black(throughput)) return;
    out_.store({point_, wo_, throughput, path_.frames, path_.length, at_.part.hit, path_.start, path_.bounces, lobes,
                constant, glossy, path_.caught, path_.alone, path_.bodies.inside});
  }

  constexpr Spectrum if_light(const Spectrum& carried) {
    if (is_light(carried)) return carried;
    out_.reject_material(path_, at_.shape.material);
    return {};
  }

  const CameraWave& wave_;
  const CameraState& path_;
  const Arrival& at_;
  const SurfaceGeometry& point_;
  Vec3 wo_;
  Out& out_;
};

/// Takes the path to what it meets next. `out` has
///   void segment(const CameraState&, const HitPartition&)   a ray was traced
///   void see(const WaveSight&)                              lights may be seen
///   void store(const WaveHitPoint&)
///   void push(const CameraState&)                           the path goes on, in the next wave
///   void reject_shape(const CameraState&, int), reject_material(const CameraState&, int)   values that are not finite
template <class Query, class Out>
constexpr void step(const PlainScene& scene, const Query& query, const CameraWave& wave, const CameraState& path,
                    Out& out) {
  struct Tracer {
    const CameraWave& wave;
    Out& out;

    constexpr void escaped(const CameraState& here, const FrameHit& part) const {
      out.see({here, part, {}, WaveSight::Kind::escape});
    }
    constexpr void lost(const CameraState& here, int shape) const { out.reject_shape(here, shape); }
    constexpr void arrived(const CameraState& before, const Arrival& at) const {
      CameraState here = before;
      here.length += at.part.hit.t;
      if (here.bounces == 0) here.caught = at.shape.catches_shadows;
      if (at.shape.emits) out.see({here, at.part, {}, WaveSight::Kind::emission});
      if (here.bounces >= wave.max_depth) return;
      CameraAtSurface<Out> surface(wave, here, at, out);
      at.for_each_state([&](FrameSet, const PlainMaterial& material) {  // only one, see why_not_in_waves()
        material.with_bsdf(at.point, wave.wavelength.of_path(here.alone),
                           [&](const auto& bsdf) { surface.arrive(bsdf); });
      });
    }
  };
  for_each_arrival(scene, query, path, out, Tracer{wave, out});
}

}  // namespace dspm
