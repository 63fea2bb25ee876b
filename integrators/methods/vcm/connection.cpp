#include "dspm/integrators/methods/vcm/connection.h"

namespace dspm {

void LightSubpath::load(const Scene& scene, std::span<const LightVertex> vertices, const StrandTable& strands) {
  ends_.clear();
  surfaces_.clear();
  for (const LightVertex& light : vertices) {
    if (light.medium != kNoMedium)
      load_in_medium(scene, light, strands.of(light.strands));
    else
      load_on_surface(scene, light, strands.of(light.strands));
  }
}

void LightSubpath::load_on_surface(const Scene& scene, const LightVertex& light, const Strand* strands) {
  Vertex met(scene, {{}, -light.wi}, {light.frames, light.hit});
  met.point.outside_eta = light.outside_eta, met.point.outside_dispersion = light.outside_dispersion;
  met.point.wavelength = light.wavelength;
  for_each_relief(met, [&](const Vertex& vertex) {  // the same in all of its frames, or it would have parted
    const std::size_t first = surfaces_.size();
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      surfaces_.push_back({frames, BsdfSlot::copy_of(bsdf)});
    });
    ends_.push_back({&light, strands, vertex.point.p, vertex.point.ng, first, surfaces_.size() - first});
  });
}

void LightSubpath::load_in_medium(const Scene& scene, const LightVertex& light, const Strand* strands) {
  const std::size_t first = surfaces_.size();
  scene.media[static_cast<std::size_t>(light.medium)].states.for_each(
      light.frames, [&](FrameSet frames, const Medium& medium) {
        const CarriedMedium here = medium.carried(medium.at(light.p), *scene.palette);
        surfaces_.push_back({frames, {}});
        surfaces_.back().bsdf.emplace<PhaseBsdf>(here.albedo(), HenyeyGreenstein(here.g));
      });
  ends_.push_back({&light, strands, light.p, {}, first, surfaces_.size() - first});
}

FrameSet LightSubpath::join(const VcmPass& pass, const Beginning& camera, std::span<const Surface> surfaces,
                            const SubpathWeights& weights, const End& end, FrameSet frames,
                            FrameArray<Brought>& parts) const {
  const Vec3 &wo = camera.wo, &w = camera.w, &wi = end.vertex->wi;
  const float distance2 = camera.distance * camera.distance, area = camera.area_cosine / distance2,
              area_of_light = end.area_cosine(w) / distance2;
  FrameSet joined;
  for (const Surface& seen : surfaces) {
    const LobeSet lobes = seen.bsdf->all_lobes();
    const Spectrum f = seen.bsdf->evaluate(wo, w, Transport::radiance, lobes);
    if ((seen.frames & frames).empty() || is_black(f) || seen.bsdf->enters(w)) continue;
    const float pdf_w = seen.bsdf->pdf_w(wo, w, Transport::radiance, lobes);
    const float reverse_pdf_w = seen.bsdf->pdf_w(w, wo, Transport::flux, lobes);
    for (const Surface& lit : std::span(surfaces_).subspan(end.first, end.count)) {
      const FrameSet common = seen.frames & lit.frames & frames;
      if (common.empty()) continue;
      const LobeSet all = lit.bsdf->all_lobes();
      const Spectrum sent = lit.bsdf->evaluate(-w, wi, Transport::radiance, all);
      if (is_black(sent) || lit.bsdf->enters(-w)) continue;
      const float light_pdf_w = lit.bsdf->pdf_w(wi, -w, Transport::flux, all);
      const float light_reverse_pdf_w = lit.bsdf->pdf_w(-w, wi, Transport::radiance, all);
      const float weight = weight_of_connection(
          pass.ways, {end.vertex->weights, light_reverse_pdf_w, pdf_w * area_of_light, end.vertex->merging},
          {weights, reverse_pdf_w, light_pdf_w * area, merging_after(camera.ways, light_pdf_w)});
      const bool is_alone = camera.is_alone || seen.bsdf->disperses(wo, w);
      const Spectrum sent_on = end.vertex->flux * sent * end.vertex->hue_by(*lit.bsdf, -w, is_alone);
      const Spectrum radiance = sent_on * f * (area_of_light * camera.cosine * weight);
      parts.add({common, radiance, end.strands, end.vertex->light});
      joined |= common;
    }
  }
  return joined;
}

}  // namespace dspm
