// Merges a vertex of a camera subpath with those of all light subpaths around it.
#pragma once

#include <cmath>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/methods/vcm/camera_vertex.h"
#include "dspm/integrators/methods/vcm/light_vertex_map.h"
#include "dspm/integrators/methods/vcm/subpath_place.h"
#include "dspm/integrators/methods/vcm/vcm_pass.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/photons/same_surface.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The weight of a merge, if `bsdf` scatters the light from wi at a camera's vertex.
template <class Place>
float merging_weight(const VcmWays& ways, const CameraVertex<Place>& camera, const LightVertex& light,
                     const Bsdf& bsdf) {
  const LobeSet lobes = bsdf.all_lobes();
  const Vec3 &wo = camera.place.wo, &wi = light.wi;
  return weight_of_merging(ways, {light.weights, bsdf.pdf_w(wo, wi, Transport::radiance, lobes)},
                           {camera.weights, bsdf.pdf_w(wi, wo, Transport::flux, lobes)});
}

/// Calls fn(const Brought&) for each merge on a curve, with the light that nothing else brings there.
template <class Fn>
void for_each_merge_on_curve(const VcmPass& pass, const LightVertexMap& map, const CameraVertex<Vertex>& camera,
                             FrameSet frames, const Bsdf& bsdf, GatherCounts& counts, Fn&& fn) {
  const Vertex& vertex = camera.place;
  const StripPlace place(vertex.shape, vertex.hit, vertex.wo);
  counts.gathers.add(frames.count());
  counts.tests += map.on_curves().for_each_within(
      place, pass.radius, [&](const CurvePhoton& light, const Strand* strands, float irradiance, const auto&) {
        const FrameSet common = light.frames & frames;
        if (common.empty() || camera.bounces + light.bounces + 1 > pass.settings.max_depth) return;
        counts.found.add(common.count());
        const Spectrum f = bsdf.evaluate(vertex.wo, light.wi, Transport::radiance, bsdf.all_lobes());
        const float share =
            irradiance * std::abs(dot(light.wi, vertex.point.ns)) / static_cast<float>(pass.settings.photons);
        const bool has_hue = camera.is_alone || bsdf.disperses(vertex.wo, light.wi);
        fn(Brought{common, light.flux * f * hue_of_found(light.only_nm, has_hue) * share, strands, light.light});
      });
}

/// Calls fn(const Brought&) for each merge in these frames, in which the vertex scatters by `bsdf`.
template <class Fn>
void for_each_merge(const VcmPass& pass, const LightVertexMap& map, const CameraVertex<Vertex>& camera, FrameSet frames,
                    const Bsdf& bsdf, GatherCounts& counts, Fn&& fn) {
  const Vertex& vertex = camera.place;
  if (vertex.point.turns) return for_each_merge_on_curve(pass, map, camera, frames, bsdf, counts, fn);
  const LobeSet lobes = bsdf.all_lobes();
  const SurfacePoint& point = vertex.point;
  const SameSurface surface(point.p, dot(vertex.wo, point.ng) < 0 ? -point.ng : point.ng, point.p_error,
                            ShapeFace(vertex.hit.shape, point.ng, vertex.wo), pass.radius);
  const bool transmits = bsdf.transmits(lobes);
  counts.gathers.add(frames.count());
  counts.tests += map.for_each_within(
      point.p, pass.radius * pass.radius, frames, [&](const LightVertex& light, const Strand* strands) {
        const FrameSet common = light.frames & frames;
        if (common.empty() || camera.bounces + light.bounces + 1 > pass.settings.max_depth) return;
        counts.found.add(common.count());
        if (transmits && !surface.counts(light.p, light.wi, light.face)) return;
        const Spectrum f = bsdf.evaluate(vertex.wo, light.wi, Transport::radiance, lobes);
        if (is_black(f)) return;
        const float weight = merging_weight(pass.ways, camera, light, bsdf);
        const bool is_alone = camera.is_alone || bsdf.disperses(vertex.wo, light.wi);
        const Spectrum radiance = light.flux * f * light.hue_on_merging(is_alone) * (weight / pass.ways.merging);
        fn(Brought{common, radiance, strands, light.light});
      });
}

/// The same in a medium: light subpaths have collided within a ball as often as light is scattered there.
template <class Fn>
void for_each_merge(const VcmPass& pass, const LightVertexMap& map, const CameraVertex<MediumVertex>& camera,
                    FrameSet frames, const Bsdf& bsdf, GatherCounts& counts, Fn&& fn) {
  const MediumVertex& vertex = camera.place;
  const VcmWays ways = ways_at(pass.ways, vertex);
  const float radius2 = pass.radius_in_media * pass.radius_in_media;
  counts.gathers.add(frames.count());
  counts.tests +=
      map.for_each_in_media_within(vertex.point, radius2, [&](const LightVertex& light, const Strand* strands) {
        const FrameSet common = light.frames & frames;
        const bool too_deep = camera.bounces + light.bounces + 1 > pass.settings.max_depth;
        if (common.empty() || too_deep || light.medium != vertex.medium) return;
        counts.found.add(common.count());
        const Spectrum f = bsdf.evaluate(vertex.wo, light.wi, Transport::radiance, bsdf.all_lobes());
        if (is_black(f)) return;
        const float weight = merging_weight(ways, camera, light, bsdf);
        const Spectrum weighted =
            light.flux * f * light.hue_on_merging(camera.is_alone) * (weight / pass.ways.merging_in_media);
        pass.scene.media[static_cast<std::size_t>(light.medium)].states.for_each(
            common, [&](FrameSet alike, const Medium& medium) {
              const Spectrum sigma_t = medium.carried(medium.at(light.p), *pass.scene.palette).sigma_t();
              Spectrum radiance;
              for (int c = 0; c < 3; ++c) radiance[c] = weighted[c] > 0 ? weighted[c] / sigma_t[c] : 0;
              fn(Brought{alike, radiance, strands, light.light});
            });
      });
}

}  // namespace dspm
