// Direct light that shadow rays bring to the vertices of hit points' camera paths.
#pragma once

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/beam_light.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/hit_point_writer.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/transport/balance.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/transport/medium_passage.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class HitPointLight {
 public:
  HitPointLight(const Scene& scene, const HitPointSettings& settings, HitPointWriter& out)
      : scene_(scene), settings_(settings), out_(out), of_beams_(scene, out) {}

  /// Adds direct light that a medium scatters along a section of the path's segment.
  void add(const CameraPath& path, const MediumSection& section) {
    if (settings_.light_media && path.bounces < settings_.max_depth) of_beams_.add(path, section);
  }

  /// Adds direct light by one shadow ray, and by another for each light that a ray tells all about. Rough lobes do not
  /// wait until they are chosen, and share the ray with glossy ones: highlights of a coat need no path that chooses the
  /// coat. If photons bring rough lobes their light, glossy ones get a ray once they are chosen. Once the path has left
  /// a hit point, photons there bring what glossy lobes scatter.
  void add(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice) {
    const bool at_once = settings_.sample_direct;
    const auto others = static_cast<LobeSet>(bsdf.all_lobes() & ~choice.lobes);
    const LobeSet rough = !at_once ? LobeSet{0} : choice.rough ? choice.lobes : others;
    const LobeSet smooth = path.indirect || (!at_once && choice.rough) ? LobeSet{0}
                           : choice.rough                              ? others
                                                                       : choice.lobes;
    const auto glossy = static_cast<LobeSet>(smooth & bsdf.lobes(kLeastRoughness));
    if (rough == 0 && glossy == 0) return;
    const float chance = !at_once ? 1 : choice.rough ? 1 - choice.chance : choice.chance;
    const auto scattered = [&](const LightSample& sample) {
      return by_rough_lobes(vertex, bsdf, rough, sample) +
             by_glossy_lobes(vertex, bsdf, glossy, smooth, chance, sample);
    };
    const float factor = at_once ? 1 : 1 / choice.chance;
    sample_direct_light(
        scene_, path, vertex, path.frames, out_.paths(), scattered,
        [&](FrameSet frames, const Rgb& radiance, auto&& giver) { out_.see(path, frames, radiance * factor, giver); },
        at_once ? DeltaLights::each : DeltaLights::chosen);
  }

 private:
  /// Returns f of a light's sample, weighted as one of the ways by which light finds a hit point.
  Rgb by_rough_lobes(const Vertex& vertex, const Bsdf& bsdf, LobeSet rough, const LightSample& sample) const {
    if (rough == 0) return {};
    const Rgb f = bsdf.evaluate(vertex.wo, sample.lit.wi, Transport::radiance, rough);
    if (is_black(f) || settings_.direct == nullptr) return f;
    return f * settings_.direct->weight_of_sample(sample, {vertex.point.p, vertex.point.ng});
  }

  /// Returns f of a light's sample, weighted against rays that `smooth` lobes, glossy ones among them, scatter if they
  /// are chosen, with probability `chance`.
  static Rgb by_glossy_lobes(const Vertex& vertex, const Bsdf& bsdf, LobeSet glossy, LobeSet smooth, float chance,
                             const LightSample& sample) {
    if (glossy == 0) return {};
    const Rgb f = bsdf.evaluate(vertex.wo, sample.lit.wi, Transport::radiance, glossy);
    if (is_black(f) || !(sample.pdf_w > 0)) return f;
    return f * balance(sample.pdf_w, chance * bsdf.pdf_w(vertex.wo, sample.lit.wi, Transport::radiance, smooth));
  }

  const Scene& scene_;
  const HitPointSettings& settings_;
  HitPointWriter& out_;
  BeamLight of_beams_;
};

}  // namespace dspm
