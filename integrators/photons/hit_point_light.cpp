#include "dspm/integrators/photons/hit_point_light.h"

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/transport/balance.h"
#include "dspm/integrators/transport/direct_light.h"

namespace dspm {
namespace {

/// The lobes of a surface that get light from samples.
struct Lit {
  FrameSet frames;
  const Bsdf* bsdf;
  LobeSet rough, glossy;
  LobeSet smooth;  // glossy ones among them
  float chance;    // that smooth ones are chosen
  float factor;    // for lobes that had to be chosen
};

Lit lit_lobes(const HitPointSettings& settings, const CameraPath& path, const HitPointLight::Surface& surface) {
  const Bsdf& bsdf = *surface.bsdf;
  const LobeChoice& choice = surface.choice;
  const bool at_once = settings.sample_direct;
  const auto others = static_cast<LobeSet>(bsdf.all_lobes() & ~choice.lobes);
  const LobeSet rough = !at_once ? LobeSet{0} : choice.rough ? choice.lobes : others;
  const LobeSet smooth = path.indirect || (!at_once && choice.rough) ? LobeSet{0}
                         : choice.rough                              ? others
                                                                     : choice.lobes;
  return {.frames = surface.frames,
          .bsdf = &bsdf,
          .rough = rough,
          .glossy = static_cast<LobeSet>(smooth & bsdf.lobes(kLeastRoughness)),
          .smooth = smooth,
          .chance = !at_once       ? 1
                    : choice.rough ? 1 - choice.chance
                                   : choice.chance,
          .factor = at_once ? 1 : 1 / choice.chance};
}

/// The weight of a light's sample as one of the ways by which light finds a hit point, once it is asked for.
class RoughWeight {
 public:
  RoughWeight(const DirectBalance* direct, const LightSample& sample, const Vertex& vertex)
      : direct_(direct), sample_(sample), vertex_(vertex) {}
  float operator()() {
    if (weight_ < 0)
      weight_ = direct_ == nullptr ? 1 : direct_->weight_of_sample(sample_, {vertex_.point.p, vertex_.point.ng});
    return weight_;
  }

 private:
  const DirectBalance* direct_;
  const LightSample& sample_;
  const Vertex& vertex_;
  float weight_ = -1;
};

Spectrum by_rough_lobes(const Vertex& vertex, const Lit& lit, const LightSample& sample, RoughWeight& weight) {
  if (lit.rough == 0) return {};
  const Spectrum f = lit.bsdf->evaluate(vertex.wo, sample.lit.wi, Transport::radiance, lit.rough);
  return is_black(f) ? f : f * weight();
}

/// Returns f of a light's sample, weighted against rays that smooth lobes scatter if they are chosen.
Spectrum by_glossy_lobes(const Vertex& vertex, const Lit& lit, const LightSample& sample) {
  if (lit.glossy == 0) return {};
  const Spectrum f = lit.bsdf->evaluate(vertex.wo, sample.lit.wi, Transport::radiance, lit.glossy);
  if (is_black(f) || !(sample.pdf_w > 0)) return f;
  return f *
         balance(sample.pdf_w, lit.chance * lit.bsdf->pdf_w(vertex.wo, sample.lit.wi, Transport::radiance, lit.smooth));
}

}  // namespace

bool HitPointLight::scatters() const { return settings_.direct != nullptr && settings_.direct->scatters(); }

float HitPointLight::weight_of_scattered(const CameraPath& path, const SceneLight& light, const Light& state,
                                         const LightStart& start) const {
  return settings_.direct->weight_of_scattered(light, state, start, {path.from, path.from_ng});
}

void HitPointLight::meet_infinity(const CameraPath& path, FrameSet frames) {
  if ((path.indirect && !path.looks) || (render_.transparent && path.bounces == 0)) return;
  for_each_escape(scene_, frames, path.ray, path.bounces,
                  [&](FrameSet lit, const Spectrum& radiance, const SceneLight& scene_light, const Light& light) {
                    const float weight = path.looks ? weight_of_scattered(path, scene_light, light,
                                                                          {{path.from, -path.ray.direction}, {}, -1})
                                                    : weight_of_escape(scene_, path, scene_light, light);
                    out_.see(path, lit, radiance * weight, [&] { return light_element(scene_, scene_light); });
                  });
}

void HitPointLight::meet_surface(const CameraPath& path, const Vertex& vertex) {
  if (path.indirect && !path.looks) return;
  for_each_emission(scene_, vertex, vertex.frames, [&](FrameSet frames, const Spectrum& radiance, const Light& light) {
    const SceneLight& scene_light = scene_.lights[static_cast<std::size_t>(vertex.shape.light)];
    const float weight = path.looks
                             ? weight_of_scattered(path, scene_light, light,
                                                   {{vertex.point.p, vertex.wo}, vertex.point.ng, vertex.hit.primitive})
                             : weight_of_hit(scene_, path, vertex, light);
    out_.see(path, frames, radiance * weight, [&] { return vertex.emitter_element(); });
  });
}

void HitPointLight::add(const CameraPath& path, const Vertex& vertex, std::span<const Surface> surfaces) {
  FrameArray<Lit> all;
  FrameSet frames;
  for (const Surface& surface : surfaces) {
    const Lit lit = lit_lobes(settings_, path, surface);
    if (lit.rough == 0 && lit.glossy == 0) continue;
    all.add(lit);
    frames |= lit.frames;
  }
  if (frames.empty()) return;
  const auto scattered = [&](FrameSet of, const LightSample& sample, auto&& take) {
    RoughWeight weight(settings_.direct, sample, vertex);
    for (const Lit& lit : all) {
      const FrameSet common = lit.frames & of;
      if (common.empty()) continue;
      take(common, (by_rough_lobes(vertex, lit, sample, weight) + by_glossy_lobes(vertex, lit, sample)) * lit.factor);
    }
  };
  sample_direct_light(
      scene_, path, vertex, frames, out_.paths(), scattered,
      [&](FrameSet seeing, const Spectrum& radiance, auto&& giver) { out_.see(path, seeing, radiance, giver); },
      settings_.sample_direct ? DeltaLights::each : DeltaLights::chosen);
}

}  // namespace dspm
