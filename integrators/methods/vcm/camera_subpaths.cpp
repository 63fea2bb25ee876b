#include "dspm/integrators/methods/vcm/camera_subpaths.h"

#include <optional>
#include <span>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/methods/vcm/connection.h"
#include "dspm/integrators/methods/vcm/light_densities.h"
#include "dspm/integrators/methods/vcm/merging.h"
#include "dspm/integrators/tiles.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/roulette.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr int kTileSide = 16;
constexpr int kManyLights = -1;  // already in their groups' sums

struct CameraSubpath : CameraPath {
  SubpathWeights weights;  // beyond the last vertex
};

class CameraSubpathTracer {
 public:
  CameraSubpathTracer(const VcmPass& pass, const LightSubpaths& light, const LightVertexMap& map, SeenLightSums& sums)
      : pass_(pass), scene_(pass.scene), light_(light), map_(map), sums_(sums), branches_(pass.scene, counts_) {}

  void trace(int x, int y) {
    strands_.clear();
    pixel_ = camera_path_index(pass_.render, x, y), loaded_ = false;
    start_camera_paths(
        scene_, pass_.render, x, y, pass_.iteration,
        [&](const CameraPath& path) {
          branches_.push({path, {}});
        },
        [&](const CameraPath& path) { reject(path, path.frames, {SceneElement::Kind::camera}); });
    branches_.follow(*this);
    branches_.count_path();
  }

  const PathCounts& counts() const { return counts_; }
  const GatherCounts& gathers() const { return gathers_; }

 private:
  friend BranchingPath<CameraSubpath>;
  friend MediumSegment<BranchingPath<CameraSubpath>>;

  /// The pixel's light subpath, the same in any crop.
  const LightSubpath& light_subpath() {
    if (!loaded_) {
      const StrandTable* strands = nullptr;
      const auto vertices = light_.of(pixel_ % static_cast<std::uint64_t>(pass_.settings.photons), strands);
      light_subpath_.load(scene_, vertices, *strands);
    }
    loaded_ = true;
    return light_subpath_;
  }

  bool postpones(const CameraSubpath&, const HitPartition&) { return false; }
  StrandTable& strands() { return strands_; }

  void escaped(const CameraSubpath& path, FrameSet frames) {
    if (pass_.render.transparent && path.bounces == 0) return;
    const Vec3& w = path.ray.direction;
    for_each_escape(scene_, frames, path.ray, path.bounces,
                    [&](FrameSet lit, const Spectrum& radiance, const SceneLight& scene_light, const Light& light) {
                      const float next_event =
                          light_samples(scene_, scene_light, path.departure()) * light.escaped_pdf_w(path.ray);
                      const LightStart start{{path.ray.origin, -w}, {}, -1};
                      // Nothing else finds a light that the camera sees.
                      const float emission = path.bounces > 0 ? emission_density(pass_, scene_light, light, start) : 0;
                      add(path,
                          {lit, radiance * weight_of_hit(path, next_event, emission), nullptr,
                           light_element(scene_, scene_light).index},
                          [&] { return light_element(scene_, scene_light); });
                    });
  }

  void lost(const CameraSubpath& path, FrameSet frames, const SceneElement& giver) { reject(path, frames, giver); }

  void arrived(const CameraSubpath& path, const Vertex& vertex) {
    const float cosine = std::abs(dot(vertex.wo, vertex.point.ng));
    if (!(cosine > 0)) return;
    CameraSubpath here = path;
    here.frames = vertex.frames, here.travel(vertex.hit.t);
    here.arrive(scene_, vertex);
    here.weights = vertex.point.turns ? SubpathWeights{} : weights_on_arrival(path, vertex);
    add_emission(here, vertex);
    scatter_light(here, vertex);
  }

  void collided(const CameraSubpath& path, const MediumVertex& vertex) {
    CameraSubpath here = path;
    here.travel(vertex.distance);
    here.collide();
    here.weights = weights_on_arrival(path, vertex);
    scatter_light(here, vertex);
  }

  /// Nothing else finds what media give off: no light subpath starts there.
  void glowed(const CameraSubpath& passing, FrameSet frames, const Spectrum& radiance) {
    CameraSubpath path = passing;
    path.collide();
    const SceneElement giver = glow_element(scene_, path.inside.medium);
    add(path, {frames, radiance, nullptr, light_of(giver)}, [&] { return giver; });
  }

  template <class Place>
  SubpathWeights weights_on_arrival(const CameraSubpath& path, const Place& place) const {
    const float cosine = area_cosine(place, place.wo), length = length_to(place);
    return path.bounces > 0 ? path.weights.arrived(length * length, cosine, path.walk.is_inside())
                            : weights_at_first_vertex(path, place.p(), cosine);
  }

  /// Brings light to the place, which sends it back along the path, and goes on.
  template <class Place>
  void scatter_light(const CameraSubpath& path, const Place& place) {
    if (path.bounces >= pass_.settings.max_depth) return;
    FrameArray<Surface> surfaces;
    FrameArray<SubpathScattering> scattered;
    for_each_scattering(place, path.frames, [&](FrameSet frames, const Bsdf& bsdf) {
      if (can_connect(bsdf)) surfaces.add({frames, BsdfSlot::copy_of(bsdf)});
      const auto scattering = scatter(path, place.wo, frames, bsdf, Transport::radiance);
      if (scattering && is_finite(scattering->sample.wi))
        scattered.add(*scattering);
      else if (scattering)
        reject(path, frames, place.scatterer());
    });
    if (!surfaces.empty()) bring_light(path, place, std::span<const Surface>(surfaces));
    for_each_joint(scattered, pass_.settings.share_paths,
                   [&](const SubpathScattering& first, std::span<const FrameFactor> factors) {
                     extend(path, place, first, factors);
                   });
  }

  /// A camera that cannot tell where it sees a point has no light subpaths connected to it.
  SubpathWeights weights_at_first_vertex(const CameraSubpath& path, const Vec3& p, float cosine) const {
    if (pass_.ways.sighting == 0) return {};
    const auto sight = path.camera->sight(p, path.random.pair(0, kLightDirection));
    return sight ? SubpathWeights::at_first_vertex(pass_.ways, sight->pixels_per_area * cosine) : SubpathWeights{};
  }

  /// `next_event` is the density, by solid angle, of a shadow ray from the last vertex to the light.
  float weight_of_hit(const CameraSubpath& path, float next_event, float emission) const {
    return dspm::weight_of_hit(pass_.ways, path.pdf_w > 0 ? next_event / path.pdf_w : 0, emission, path.weights);
  }

  void add_emission(const CameraSubpath& path, const Vertex& vertex) {
    for_each_emission(scene_, vertex, path.frames, [&](FrameSet lit, const Spectrum& radiance, const Light& light) {
      const SceneLight& scene_light = scene_.lights[static_cast<std::size_t>(vertex.shape.light)];
      const SurfacePoint& point = vertex.point;
      const int primitive = vertex.hit.primitive;
      const float next_event = path.pdf_w > 0 ? light_samples(scene_, scene_light, path.departure()) *
                                                    light.pdf_w(path.from, point, primitive)
                                              : 0;
      const float emission = emission_density(pass_, scene_light, light, {{point.p, vertex.wo}, point.ng, primitive});
      add(path, {lit, radiance * weight_of_hit(path, next_event, emission), nullptr, vertex.shape.light},
          [&] { return vertex.emitter_element(); });
    });
  }

  /// Brings light to surfaces that can be connected.
  template <class Place>
  void bring_light(const CameraSubpath& path, const Place& place, std::span<const Surface> surfaces) {
    add_next_event(path, place, surfaces);
    const CameraVertex<Place> camera{place,       surfaces,    path.frames,  path.bounces,
                                     path.inside, path.random, path.weights, path.wavelength.alone};
    if (pass_.ways.merging > 0)
      for (const auto& [frames, bsdf] : surfaces) merge(path, camera, frames, *bsdf);
    if (pass_.ways.connecting)
      light_subpath().for_each_connection(pass_, camera, counts_, [&](const Brought& brought) {
        add(path, brought, [&] { return place.scatterer(); });
      });
  }

  /// Frames whose surfaces differ share samples and rays.
  template <class Place>
  void add_next_event(const CameraSubpath& path, const Place& place, std::span<const Surface> surfaces) {
    const VcmWays ways = ways_at(pass_.ways, place);
    FrameSet frames;
    for (const Surface& surface : surfaces) frames |= surface.frames;
    const auto scattered = [&](FrameSet of, const LightSample& sample, auto&& take) {
      const Vec3& wi = sample.lit.wi;
      std::optional<float> emission;
      for (const auto& [in_frames, bsdf] : surfaces) {
        const FrameSet common = in_frames & of;
        if (common.empty()) continue;
        const LobeSet lobes = bsdf->all_lobes();
        const Spectrum f = bsdf->evaluate(place.wo, wi, Transport::radiance, lobes);
        if (is_black(f)) continue;
        if (!emission) emission = emission_over_next_event(pass_, sample, place.receiver(), area_cosine(place, wi));
        const float hit = sample.pdf_w > 0 ? bsdf->pdf_w(place.wo, wi, Transport::radiance, lobes) / sample.pdf_w : 0;
        take(common, f * weight_of_next_event(ways, hit,
                                              {path.weights, bsdf->pdf_w(wi, place.wo, Transport::flux, lobes),
                                               *emission, merging_after(ways, 0)}));
      }
    };
    sample_direct_light(scene_, path, place, frames, counts_, scattered,
                        [&](FrameSet lit, const Spectrum& radiance, auto&& giver) {
                          add(path, {lit, radiance, nullptr, light_of(giver())}, giver);
                        });
  }

  void merge(const CameraSubpath& path, const CameraVertex<Vertex>& camera, FrameSet frames, const Bsdf& bsdf) {
    const auto giver = [&] { return camera.place.material_element(); };
    Spectrum shared;  // by all frames
    for_each_merge(pass_, map_, camera, frames, bsdf, gathers_, [&](const Brought& brought) {
      const bool by_all = brought.frames == frames && brought.strands == nullptr && !camera.place.point.turns;
      if (!by_all || !is_light(brought.radiance)) return add(path, brought, giver);
      shared += brought.radiance;
      if (sums_.has_parts()) add_to_part(path, brought);
    });
    if (!is_black(shared)) add(path, {frames, shared, nullptr, kManyLights}, giver);
  }
  void merge(const CameraSubpath& path, const CameraVertex<MediumVertex>& camera, FrameSet frames, const Bsdf& bsdf) {
    for_each_merge(pass_, map_, camera, frames, bsdf, gathers_,
                   [&](const Brought& brought) { add(path, brought, [&] { return camera.place.scatterer(); }); });
  }

  template <class Place>
  void extend(const CameraSubpath& path, const Place& place, const SubpathScattering& scattering,
              std::span<const FrameFactor> factors) {
    const BsdfSample& sample = scattering.sample;
    CameraSubpath& branch = branches_.push(path);
    leave(branch, place, sample);
    const float cosine = area_cosine(place, sample.wi);
    branch.weights = sample.specular ? path.weights.mirrored(cosine)
                                     : path.weights.camera_scattered(ways_at(pass_.ways, place), sample.pdf_w,
                                                                     scattering.reverse_pdf_w, cosine);
    const float u = path.random.number(path.bounces, kRoulette);
    const auto roulette = [&](StrandList, FrameSet frames, const Spectrum&, const Spectrum& after) {
      if (!is_light(after)) {
        reject(path, frames, place.scatterer());
        return Spectrum();
      }
      const float p = roulette_chance(after, branch.eta_scale, path.bounces);
      return p >= 1 ? after : u < p ? after * (1 / p) : Spectrum();
    };
    const ByRatio by_ratio = path.bounces < kFirstRouletteBounce ? ByRatio::yes : ByRatio::no;
    if (!multiply(branch, factors, strands_, by_ratio, roulette)) branches_.drop();
  }

  /// Adds light. `giver` returns its source, which is blamed if it is negative or not finite.
  template <class WhoGave>
  void add(const CameraSubpath& path, const Brought& brought, WhoGave&& giver) {
    for_each_strand(strands_.of(path.strands), brought.frames, [&](FrameSet alike, const Spectrum& own) {
      for_each_strand(brought.strands, alike, [&](FrameSet frames, const Spectrum& weight) {
        const Spectrum seen = path.throughput * own * brought.radiance * weight;
        if (!is_light(seen)) return reject(path, frames, giver());
        sums_.add({frames, scene_.palette->seen(seen), path.pixel, brought.light, path.caught, path.of_media});
      });
    });
  }
  /// Adds the part of light without strands that is summed up before it is added.
  void add_to_part(const CameraSubpath& path, const Brought& brought) {
    for_each_strand(strands_.of(path.strands), brought.frames, [&](FrameSet alike, const Spectrum& own) {
      const Spectrum seen = path.throughput * own * brought.radiance;
      if (is_light(seen) && !path.caught)
        sums_.add_to_part({alike, scene_.palette->seen(seen), path.pixel, brought.light, false, path.of_media});
    });
  }
  void reject(const CameraPath& path, FrameSet frames, const SceneElement& giver) {
    gathers_.rejections.add(giver, frames, path.pixel);
  }

  const VcmPass& pass_;
  const Scene& scene_;
  const LightSubpaths& light_;
  const LightVertexMap& map_;
  SeenLightSums& sums_;
  PathCounts counts_;
  GatherCounts gathers_;
  std::uint64_t pixel_ = 0;
  LightSubpath light_subpath_;  // of that pixel, once loaded
  bool loaded_ = false;
  StrandTable strands_;  // of the pixel's path
  BranchingPath<CameraSubpath> branches_;
};

}  // namespace

void trace_camera_subpaths(const VcmPass& pass, const LightSubpaths& light, const LightVertexMap& map,
                           SeenLightSums& sums, Statistics& statistics) {
  const PixelRect& crop = pass.render.crop;
  const auto tiles = static_cast<std::size_t>(tile_count(crop, kTileSide));
  std::vector<PathCounts> paths(tiles);
  std::vector<GatherCounts> gathers(tiles);
  parallel_for(static_cast<std::int64_t>(tiles), 1, [&](std::int64_t t) {
    CameraSubpathTracer tracer(pass, light, map, sums);
    for_each_pixel_of_tile(crop, kTileSide, static_cast<int>(t), [&](int x, int y) { tracer.trace(x, y); });
    paths[static_cast<std::size_t>(t)] = tracer.counts(), gathers[static_cast<std::size_t>(t)] = tracer.gathers();
  });
  for (const PathCounts& counts : paths) statistics.camera += counts;
  account(gathers, statistics);
}

}  // namespace dspm
