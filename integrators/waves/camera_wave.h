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
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/integrators/waves/wave_order.h"

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
  bool alone;  // see Wavelength

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
  /// `path` has arrived in the part's frames.
  constexpr CameraAtSurface(const CameraWave& wave, const CameraState& path, const PlainPlacedShape& shape,
                            const FrameHit& part, const SurfaceGeometry& point, Out& out)
      : wave_(wave), path_(path), shape_(shape), part_(part), point_(point), wo_(-path.ray.direction), out_(out) {}

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
    if ((choice.lobes & bsdf.lobes(kLeastRoughness)) != 0) out_.see({path_, part_, choice, WaveSight::Kind::samples});
    const auto glossy = static_cast<LobeSet>(choice.lobes & glossy_lobes(bsdf, point_, wave_.least_alpha));
    if (glossy != 0 && wave_.may_hide_photons) store(Spectrum(1 / choice.chance), glossy, false, true);
    const auto sample = sample_bsdf(bsdf, wo_, Transport::radiance, choice.lobes, path_.random, path_.bounces);
    if (!sample) return;
    if (!is_finite(sample->wi)) return out_.reject_material(path_, shape_.material);
    CameraState next = path_;
    next.eta_scale *= sample->eta_scale;
    const Spectrum after = if_light(path_.throughput * (sample->weight / choice.chance));
    next.throughput = left_by_roulette(after, roulette_chance(after, next.eta_scale, path_.bounces),
                                       path_.random.number(path_.bounces, kRoulette));
    if (is_black(next.throughput)) return;
    next.ray = point_.spawn(sample->wi);
    next.from = point_.p, next.from_ng = point_.ng, next.pdf_w = sample->specular ? 0 : sample->pdf_w;
    next.alone = path_.alone || sample->by_wavelength;
    ++next.bounces;
    out_.push(next);
  }

  constexpr void store(const Spectrum& factor, LobeSet lobes, bool constant, bool glossy) {
    const Spectrum throughput = if_light(path_.throughput * factor);
    if (is_black(throughput)) return;
    out_.store({point_, wo_, throughput, path_.frames, path_.length, part_.hit, path_.start, path_.bounces, lobes,
                constant, glossy, path_.caught, path_.alone});
  }

  constexpr Spectrum if_light(const Spectrum& carried) {
    if (is_light(carried)) return carried;
    out_.reject_material(path_, shape_.material);
    return {};
  }

  const CameraWave& wave_;
  const CameraState& path_;
  const PlainPlacedShape& shape_;
  const FrameHit& part_;
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
  const HitPartition parts = query.partition(path.ray, path.frames);
  out.segment(path, parts);
  for (const FrameHit& part : parts) {
    CameraState arrived = path;
    arrived.frames = part.frames;
    if (part.hit.missed()) {
      out.see({arrived, part, {}, WaveSight::Kind::escape});
      continue;
    }
    const PlainPlacedShape& shape = scene.shape_of(part.hit);
    const SurfaceGeometry point = shape.surface_point(part.hit.primitive, part.hit.uv);
    if (!is_finite(point)) {
      out.reject_shape(arrived, part.hit.shape);
      continue;
    }
    arrived.length += part.hit.t;
    if (path.bounces == 0) arrived.caught = shape.catches_shadows;
    if (shape.emits) out.see({arrived, part, {}, WaveSight::Kind::emission});
    if (path.bounces >= wave.max_depth) continue;
    CameraAtSurface<Out> surface(wave, arrived, shape, part, point, out);
    scene.materials[shape.material].with_bsdf(point, wave.wavelength.of_path(path.alone),
                                              [&](const auto& bsdf) { surface.arrive(bsdf); });
  }
}

}  // namespace dspm
