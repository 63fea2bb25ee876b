// Direct light that shadow rays bring to the vertices of hit points' camera paths.
#pragma once

#include <span>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frame_array.h"
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

  /// What a vertex is made of in some of its frames, and the lobes that were chosen there.
  struct Surface {
    FrameSet frames;
    const Bsdf* bsdf;
    LobeChoice choice;
  };

  /// Adds direct light by one shadow ray, and by another for each light that a ray tells all about. Rough lobes do not
  /// wait until they are chosen, and share the ray with glossy ones: highlights of a coat need no path that chooses the
  /// coat. If photons bring rough lobes their light, glossy ones get a ray once they are chosen. Once the path has left
  /// a hit point, photons there bring what glossy lobes scatter. Frames whose surfaces differ share samples and rays.
  void add(const CameraPath& path, const Vertex& vertex, std::span<const Surface> surfaces) {
    FrameArray<Lit> all;
    FrameSet frames;
    for (const Surface& surface : surfaces) {
      const Lit lit = lit_lobes(path, surface);
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
        [&](FrameSet seeing, const Rgb& radiance, auto&& giver) { out_.see(path, seeing, radiance, giver); },
        settings_.sample_direct ? DeltaLights::each : DeltaLights::chosen);
  }

 private:
  /// The lobes of a surface that get light from samples.
  struct Lit {
    FrameSet frames;
    const Bsdf* bsdf;
    LobeSet rough, glossy;
    LobeSet smooth;  // glossy ones among them
    float chance;    // that smooth ones are chosen
    float factor;    // for lobes that had to be chosen
  };

  Lit lit_lobes(const CameraPath& path, const Surface& surface) const {
    const Bsdf& bsdf = *surface.bsdf;
    const LobeChoice& choice = surface.choice;
    const bool at_once = settings_.sample_direct;
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

  static Rgb by_rough_lobes(const Vertex& vertex, const Lit& lit, const LightSample& sample, RoughWeight& weight) {
    if (lit.rough == 0) return {};
    const Rgb f = lit.bsdf->evaluate(vertex.wo, sample.lit.wi, Transport::radiance, lit.rough);
    return is_black(f) ? f : f * weight();
  }

  /// Returns f of a light's sample, weighted against rays that smooth lobes scatter if they are chosen.
  static Rgb by_glossy_lobes(const Vertex& vertex, const Lit& lit, const LightSample& sample) {
    if (lit.glossy == 0) return {};
    const Rgb f = lit.bsdf->evaluate(vertex.wo, sample.lit.wi, Transport::radiance, lit.glossy);
    if (is_black(f) || !(sample.pdf_w > 0)) return f;
    return f * balance(sample.pdf_w,
                       lit.chance * lit.bsdf->pdf_w(vertex.wo, sample.lit.wi, Transport::radiance, lit.smooth));
  }

  const Scene& scene_;
  const HitPointSettings& settings_;
  HitPointWriter& out_;
  BeamLight of_beams_;
};

}  // namespace dspm
