// Final gather: rays from a hit point into the scene, each ending in a photon map estimate. [Jensen 1996]
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/radiance_estimate.h"
#include "dspm/integrators/tiles.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/lobe_choice.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct FinalGatherSettings {
  int rays = 0;  // per hit point
  float least_alpha = 0.25f;
  int max_depth = 5;  // scatterings of a gather ray before its estimate: in hair, all lobes are followed
};

/// Traces the gather rays of a tile. Reports their results to add(const HitPoint& from, FrameSet, const Spectrum&, int
/// group), as estimate_radiance() does.
template <class Add>
class FinalGather {
 public:
  FinalGather(const Scene& scene, const RenderSettings& render, const FinalGatherSettings& settings,
              const PhotonMap& map, const RadianceEstimate& how, GatherCounts& counts, PathCounts& paths, Add add)
      : render_(render),
        settings_(settings),
        map_(map),
        how_(how),
        counts_(counts),
        add_(add),
        branches_(scene, paths) {}

  void gather(const HitPoint& hit, const Scattering& scattering, std::uint64_t iteration) {
    SurfacePoint point;
    point.p = hit.p, point.p_error = scattering.p_error, point.ng = point.ns = hit.ng;
    const int x = render_.crop.x0 + hit.pixel % render_.crop.width(),
              y = render_.crop.y0 + hit.pixel / render_.crop.width();
    for (int ray = 0; ray < settings_.rays; ++ray) {
      GatherPath path;
      path.random =
          PathRandom(render_.seed, Stream::final_gather, camera_path_index(render_, x, y),
                     iteration * static_cast<std::uint64_t>(settings_.rays) + static_cast<std::uint64_t>(ray));
      path.throughput = hit.throughput / static_cast<float>(settings_.rays), path.wavelength = hit.wavelength;
      path.frames = hit.frames, path.from = &hit;
      const auto sample = sample_bsdf(*scattering.bsdf, path, scattering.wo, Transport::radiance, scattering.lobes);
      if (!sample) continue;
      path.throughput *= sample->weight;
      extend_ray(path, point, *sample);
      path.inside = scattering.inside;  // lobes that gather hardly ever transmit
      if (!is_valid(path, {SceneElement::Kind::material, scattering.material})) continue;
      branches_.push(path);
      branches_.follow(*this);
    }
  }

 private:
  struct GatherPath : PathState {
    const HitPoint* from = nullptr;
  };
  friend BranchingPath<GatherPath>;
  friend MediumSegment<BranchingPath<GatherPath>>;

  bool postpones(const GatherPath&, const HitPartition&) { return false; }
  void escaped(const GatherPath&, FrameSet) {}
  void lost(const GatherPath& path, FrameSet frames, const SceneElement& giver) {
    counts_.rejections.add(giver, frames, path.from->pixel);
  }

  void arrived(const GatherPath& path, const Vertex& vertex) {
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      GatherPath branch = path;
      branch.frames = frames;
      const LobeChoice choice = choose_lobes(bsdf, branch, vertex, settings_.least_alpha);
      branch.throughput *= 1 / choice.chance;
      if (choice.rough)
        end(branch, vertex, bsdf, choice.lobes);
      else if (branch.bounces < settings_.max_depth)
        scatter(branch, vertex, bsdf, choice.lobes);
    });
  }

  void end(const GatherPath& path, const Vertex& vertex, const Bsdf& bsdf, LobeSet lobes) {
    const SurfacePoint& point = vertex.point;
    HitPoint hit = *path.from;
    hit.p = point.p, hit.ng = dot(vertex.wo, point.ng) < 0 ? -point.ng : point.ng;
    hit.face = ShapeFace(vertex.hit.shape, point.ng, vertex.wo);
    hit.throughput = path.throughput, hit.frames = path.frames, hit.wavelength = path.wavelength;
    const Scattering scattering{BsdfSlot::copy_of(bsdf),
                                vertex.wo,
                                point.p_error,
                                lobes,
                                bsdf.transmits(bsdf.all_lobes()),
                                vertex.material_element().index,
                                path.inside,
                                point.ns,
                                unbent_normal(point)};
    estimate_radiance(hit, &scattering, map_, how_, counts_, [&](FrameSet frames, const Spectrum& radiance, int group) {
      add_(hit, frames, radiance, group);
    });
  }

  void scatter(GatherPath& path, const Vertex& vertex, const Bsdf& bsdf, LobeSet lobes) {
    const auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::radiance, lobes);
    if (!sample) return;
    extend(path, vertex, *sample);
    if (!is_black(path.throughput) && is_valid(path, vertex.material_element())) branches_.push(path);
  }

  bool is_valid(const GatherPath& path, const SceneElement& giver) {
    const bool valid = is_light(path.throughput) && is_finite(path.ray);
    if (!valid) lost(path, path.frames, giver);
    return valid;
  }

  const RenderSettings& render_;
  FinalGatherSettings settings_;
  const PhotonMap& map_;
  const RadianceEstimate& how_;
  GatherCounts& counts_;
  Add add_;
  BranchingPath<GatherPath> branches_;
};

}  // namespace dspm
