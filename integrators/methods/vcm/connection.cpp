#include "dspm/integrators/methods/vcm/connection.h"

namespace dspm {

void LightSubpath::load(const Scene& scene, std::span<const LightVertex> vertices, const StrandTable& strands) {
  ends_.clear();
  surfaces_.clear();
  for (const LightVertex& light : vertices) {
    Vertex met(scene, {{}, -light.wi}, {light.frames, light.hit});
    met.point.outside_eta = light.outside_eta;
    for_each_relief(met, [&](const Vertex& vertex) {  // the same in all of its frames, or it would have parted
      const std::size_t first = surfaces_.size();
      for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
        surfaces_.push_back({frames, BsdfSlot::copy_of(bsdf)});
      });
      ends_.push_back({&light, strands.of(light.strands), vertex.point, first, surfaces_.size() - first});
    });
  }
}

FrameSet LightSubpath::join(const VcmPass& pass, const CameraVertex& camera, const End& end, FrameSet frames,
                            const Vec3& w, float distance, FrameArray<Brought>& parts) const {
  const SurfacePoint& point = camera.vertex.point;
  const Vec3 &wo = camera.vertex.wo, &wi = end.vertex->wi;
  const float distance2 = distance * distance, area = std::abs(dot(w, point.ng)) / distance2,
              area_of_light = std::abs(dot(w, end.point.ng)) / distance2;
  FrameSet joined;
  for (const Surface& seen : camera.surfaces) {
    const LobeSet lobes = seen.bsdf->all_lobes();
    const Rgb f = seen.bsdf->evaluate(wo, w, Transport::radiance, lobes);
    if ((seen.frames & frames).empty() || is_black(f) || seen.bsdf->enters(w)) continue;
    const float pdf_w = seen.bsdf->pdf_w(wo, w, Transport::radiance, lobes);
    const float reverse_pdf_w = seen.bsdf->pdf_w(w, wo, Transport::flux, lobes);
    for (const Surface& lit : std::span(surfaces_).subspan(end.first, end.count)) {
      const FrameSet common = seen.frames & lit.frames & frames;
      if (common.empty()) continue;
      const LobeSet all = lit.bsdf->all_lobes();
      const Rgb sent = lit.bsdf->evaluate(-w, wi, Transport::radiance, all);
      if (is_black(sent) || lit.bsdf->enters(-w)) continue;
      const float light_pdf_w = lit.bsdf->pdf_w(wi, -w, Transport::flux, all);
      const float light_reverse_pdf_w = lit.bsdf->pdf_w(-w, wi, Transport::radiance, all);
      const float weight = weight_of_connection(
          pass.ways, {end.vertex->weights, light_reverse_pdf_w, pdf_w * area_of_light, end.vertex->merging},
          {camera.weights, reverse_pdf_w, light_pdf_w * area, merging_after(camera.ways, light_pdf_w)});
      const Rgb radiance = end.vertex->flux * sent * f * (area_of_light * std::abs(dot(w, point.ns)) * weight);
      parts.add({common, radiance, end.strands, end.vertex->light});
      joined |= common;
    }
  }
  return joined;
}

}  // namespace dspm
