#include "dspm/integrators/methods/vcm/light_subpaths.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/system/parallel.h"
#include "dspm/integrators/methods/vcm/light_densities.h"
#include "dspm/integrators/methods/vcm/subpath_place.h"
#include "dspm/integrators/photons/photon_numbers.h"
#include "dspm/integrators/photons/photon_starts.h"
#include "dspm/integrators/photons/start_photons.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/mixed_frames.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr std::int64_t kPathsPerChunk = 2048;

struct LightPath : PathState {
  SubpathWeights weights;  // beyond the last vertex
  float merging = 0;       // what merges count at the next one
  bool hidden = false;     // see PhotonTrace::hidden
};

class LightPathTracer {
 public:
  LightPathTracer(const VcmPass& pass, const PhotonStarts& starts, LightTrace& out)
      : pass_(pass), scene_(pass.scene), starts_(starts), out_(out), branches_(pass.scene, out.paths) {}

  void trace(std::uint64_t path_index) {
    const PathRandom random = photon_numbers(pass_.render.seed, Stream::photon, path_index, pass_.iteration,
                                             pass_.render.independent_numbers);
    for (std::size_t choice = 0; choice < scene_.light_choices.size(); ++choice)
      if (!scene_.light_choices[choice].frames.empty()) start(choice, random);
    branches_.count_path();
    out_.ends.push_back(out_.vertices.size());
  }

 private:
  friend BranchingPath<LightPath>;
  friend MediumSegment<BranchingPath<LightPath>>;

  void start(std::size_t choice, const PathRandom& random) {
    const EmissionStart chosen = start_of(pass_.guides, scene_, choice, random);
    if (chosen.density == 0) return;
    const SceneLight& of = scene_.lights[static_cast<std::size_t>(chosen.light)];
    if (of.is_drowned || of.glow.medium != kNoMedium) return;  // camera paths see what glows
    for (const PhotonStart& start : starts_.of(choice, chosen.light)) {
      // States that would start alike with other densities than their own part.
      if (start.varied == nullptr || !start.varied->factors.empty())
        follow(chosen, start, random);
      else
        for (const auto& [frames, light] : start.varied->states)
          if (const FrameSet common = frames & start.frames; !common.empty())
            follow(chosen, {light.get(), common, Spectrum(1), 0, nullptr, start.inside}, random);
    }
  }

  void follow(const EmissionStart& chosen, const PhotonStart& start, const PathRandom& random) {
    const SceneLight& scene_light = scene_.lights[static_cast<std::size_t>(chosen.light)];
    const EmissionNumbers& u = chosen.numbers;
    const auto emission = start.light->emit({u[0], u[1]}, {u[2], u[3]});
    if (!emission || is_black(emission->flux) || !(emission->pdf.position * emission->pdf.direction > 0)) return;
    const Spectrum carried = carried_at_start(start, emission->flux, *scene_.palette);
    if (is_black(carried)) return;
    const Spectrum flux = carried * start.factor / chosen.density;
    if (!is_light(emission->flux) || !is_light(flux) || !is_finite(emission->ray))
      return out_.rejections.add({SceneElement::Kind::light, chosen.light}, start.frames);
    light_ = start.light, scene_light_ = &scene_light, light_index_ = chosen.light, emission_ = *emission;
    LightPath& path = branches_.push({{emission->ray, flux, start.frames}, {}});
    path.random = random, path.strands = start.strands, path.inside = start.inside, path.wavelength.nm = pass_.nm;
    path.inside.medium = scene_light.media.medium_towards(!(dot(emission->normal, emission->ray.direction) < 0));
    path.merging = merging_after(pass_.ways, 0), path.hidden = scene_light.is_delta;
    if (start.varied != nullptr && !weigh(path, *start.varied, chosen.light)) return branches_.drop();
    branches_.follow(*this);
  }

  /// Weights a path for each state of a light; returns whether any weight remains.
  bool weigh(LightPath& path, const SceneLight::Alike& alike, int index) {
    FrameSet invalid;
    const auto weights = weights_of_states(*scene_.palette, alike, path.ray, emission_.flux, invalid);
    if (!invalid.empty()) out_.rejections.add({SceneElement::Kind::light, index}, invalid);
    return !weights.empty() && multiply(path, weights, out_.strands, ByRatio::yes, keep_all);
  }

  bool postpones(const LightPath&, const HitPartition&) { return false; }
  StrandTable& strands() { return out_.strands; }
  void escaped(const LightPath&, FrameSet) {}
  void lost(const LightPath&, FrameSet frames, const SceneElement& giver) { out_.rejections.add(giver, frames); }

  void arrived(const LightPath& path, const Vertex& vertex) {
    if (!(area_cosine(vertex, vertex.wo) > 0) || !may_arrive(path, vertex)) return;
    if (vertex.point.turns) return end_on_curve(path, vertex);
    scatter_light(path, vertex, mixed_frames(vertex, can_connect));
  }

  void collided(const LightPath& path, const MediumVertex& vertex) {
    if (may_arrive(path, vertex)) scatter_light(path, vertex, {});
  }

  template <class Place>
  bool may_arrive(const LightPath& path, const Place& place) const {
    if (path.bounces >= pass_.settings.max_depth) return false;
    return path.bounces > 0 || !(length_to(place) < emission_.must_reach);
  }

  /// Keeps the vertex in the frames in which it can be connected, `connecting` among them, and goes on.
  template <class Place>
  void scatter_light(const LightPath& path, const Place& place, FrameSet connecting) {
    const float cosine = area_cosine(place, place.wo), distance2 = length_to(place) * length_to(place);
    const SubpathWeights weights = path.bounces > 0 ? path.weights.arrived(distance2, cosine, path.walk.is_inside())
                                                    : weights_at_first_vertex(pass_, *scene_light_, *light_, emission_,
                                                                              place.receiver(), distance2, cosine);
    FrameArray<SubpathScattering> scattered;
    for_each_scattering(place, path.frames, [&](FrameSet frames, const Bsdf& bsdf) {
      if (can_connect(bsdf)) connecting |= frames;
      if (path.bounces + 1 < pass_.settings.max_depth)
        if (const auto scattering = scatter(path, place, frames, bsdf)) scattered.add(*scattering);
    });
    if (!connecting.empty()) store(path, weights, place, connecting);
    for_each_joint(scattered, pass_.settings.share_paths,
                   [&](const SubpathScattering& first, std::span<const FrameFactor> factors) {
                     extend(path, weights, place, first, factors);
                   });
  }

  template <class Place>
  std::optional<SubpathScattering> scatter(const LightPath& path, const Place& place, FrameSet frames,
                                           const Bsdf& bsdf) {
    auto scattering = dspm::scatter(path, place.wo, frames, bsdf, Transport::flux);
    if (!scattering) return std::nullopt;
    if (!is_finite(scattering->sample.wi)) {
      out_.rejections.add(place.scatterer(), frames);
      return std::nullopt;
    }
    scattering->factor *= correction(place, scattering->sample.wi);
    return scattering;
  }
  static float correction(const Vertex& vertex, const Vec3& wi) {
    return shading_correction(vertex.point, vertex.wo, wi);
  }
  static float correction(const MediumVertex&, const Vec3&) { return 1; }

  static void leave(LightPath& path, const Vertex& vertex, const BsdfSample& sample) {
    extend_ray(path, vertex, sample);
  }
  static void leave(LightPath& path, const MediumVertex& vertex, const BsdfSample& sample) {
    extend_ray(path, vertex, sample.wi);
  }

  template <class Place>
  void extend(const LightPath& path, const SubpathWeights& weights, const Place& place,
              const SubpathScattering& scattering, std::span<const FrameFactor> factors) {
    LightPath& branch = branches_.push(path);
    const BsdfSample& sample = scattering.sample;
    leave(branch, place, sample);
    const float cosine = area_cosine(place, sample.wi);
    branch.weights = sample.specular ? weights.mirrored(cosine)
                                     : weights.light_scattered(pass_.ways, sample.pdf_w, scattering.reverse_pdf_w,
                                                               cosine, merging_at(path, place));
    branch.hidden = path.hidden && sample.specular;
    branch.merging = sample.specular ? pass_.ways.merging : merging_after(pass_.ways, sample.pdf_w);
    const float u = path.random.number(path.bounces, kRoulette);
    const auto roulette = [&](StrandList, FrameSet frames, const Spectrum& before, const Spectrum& after) {
      if (!is_light(after)) {
        out_.rejections.add(place.scatterer(), frames);
        return Spectrum();
      }
      const float p = std::min(1.f, max_component(after) / max_component(before));
      return p >= 1 ? after : u < p ? after * (1 / p) : Spectrum();
    };
    if (!multiply(branch, factors, out_.strands, ByRatio::yes, roulette)) branches_.drop();
  }

  /// What merges count there.
  static float merging_at(const LightPath& path, const Vertex&) { return path.merging; }
  float merging_at(const LightPath& path, const MediumVertex& vertex) const {
    return path.merging > 0 ? ways_at(pass_.ways, vertex).merging : 0;
  }

  void store(const LightPath& path, const SubpathWeights& weights, const MediumVertex& vertex, FrameSet frames) {
    LightVertex stored{};
    stored.p = vertex.point, stored.wi = vertex.wo, stored.medium = vertex.medium;
    stored.flux = path.throughput, stored.strands = out_.strands.folded(path.strands, frames, stored.flux);
    stored.light = light_index_, stored.frames = frames, stored.bounces = path.bounces;
    stored.weights = weights, stored.merging = merging_at(path, vertex), stored.wavelength = path.wavelength;
    store(stored, vertex, path);
  }

  void store(const LightPath& path, const SubpathWeights& weights, const Vertex& vertex, FrameSet frames) {
    const SurfacePoint& point = vertex.point;
    // If the normals disagree about the side, every scattering function is zero.
    const float geometric = dot(vertex.wo, point.ng), shading = dot(vertex.wo, point.ns);
    if (!(geometric * shading > 0)) return;
    Spectrum flux = path.throughput * (point.ns == point.ng ? 1 : shading / geometric);
    const StrandList strands = out_.strands.folded(path.strands, frames, flux);
    const ShapeFace face(vertex.hit.shape, point.ng, vertex.wo);
    const LightVertex stored{point.p,
                             vertex.wo,
                             face,
                             flux,
                             light_index_,
                             frames,
                             strands,
                             path.bounces,
                             weights,
                             path.merging,
                             vertex.hit,
                             point.outside_eta,
                             point.outside_dispersion,
                             path.wavelength};
    store(stored, vertex, path);
  }

  template <class Place>
  void store(const LightVertex& light, const Place& place, const LightPath& path) {
    if (pass_.ways.sighting > 0) connect_to_camera(light, place, path);
    if (!pass_.settings.connect && light.merging == 0) return;
    out_.vertices.push_back(light);
    out_.stored.add(light.frames.count());
    out_.paths.weighted += light.strands != 0;
  }

  /// Ends a path on a curve with hidden light, which nothing else brings there; all other light is found by camera
  /// paths that go on.
  void end_on_curve(const LightPath& path, const Vertex& vertex) {
    if (!path.hidden || path.bounces == 0 || pass_.ways.merging == 0) return;
    FrameSet frames = mixed_frames(vertex, can_connect);
    for_each_surface(vertex, [&](FrameSet in_frames, const Bsdf& bsdf) {
      if (can_connect(bsdf)) frames |= in_frames;
    });
    if (frames.empty()) return;
    Spectrum flux = path.throughput;
    const StrandList strands = out_.strands.folded(path.strands, frames, flux);
    const ShapeFace face(vertex.hit.shape, vertex.point.ng, vertex.wo);
    out_.on_curves.push_back(
        {{vertex.point.p, face, vertex.wo, flux, frames, strands, light_index_, path.wavelength.only_nm()},
         StripPlace(vertex.shape, vertex.hit, vertex.wo),
         path.bounces});
    out_.stored.add(frames.count());
  }

  template <class Place>
  void connect_to_camera(const LightVertex& light, const Place& place, const LightPath& path) {
    const Vec2 lens = path.random.pair(light.bounces + 1, kLightPoint);
    scene_.camera.for_each(light.frames, [&](FrameSet seeing, const Camera& camera) {
      const auto sight = camera.sight(light.p, lens);
      if (sight && is_seen(sight->film, pass_.render))
        send(light, place, *sight, {place.inside_beyond(path.inside, sight->w), path.random}, seeing);
    });
  }

  struct Way {
    Inside inside;
    PathRandom random;
  };
  /// Sends light to the camera, as a radiance that is flux f times the pixels that a unit of area covers.
  template <class Place>
  void send(const LightVertex& light, const Place& place, const Sighting& sight, const Way& way, FrameSet seeing) {
    const float pdf_a = sight.pixels_per_area * area_cosine(place, sight.w);
    FrameArray<FrameFactor> parts;
    FrameSet sent;
    for_each_scattering(place, seeing, [&](FrameSet frames, const Bsdf& bsdf) {
      const FrameSet common = frames & seeing;
      if (common.empty()) return;
      const LobeSet lobes = bsdf.all_lobes();
      const Spectrum f = bsdf.evaluate(sight.w, light.wi, Transport::radiance, lobes);
      if (is_black(f)) return;
      const float reverse_pdf_w = bsdf.pdf_w(sight.w, light.wi, Transport::radiance, lobes);
      const float weight =
          weight_of_sighting(pass_.ways, {light.weights, reverse_pdf_w, pdf_a / pass_.ways.sighting, light.merging});
      const Spectrum radiance =
          light.flux * f * light.hue_by(bsdf, sight.w, false) * (pdf_a * weight / pass_.ways.sighting);
      if (!is_light(radiance)) return out_.rejections.add(place.scatterer(), common);
      parts.add({common, radiance});
      sent |= common;
    });
    if (sent.empty()) return;
    ++out_.paths.shadow_rays;
    for_each_open(
        scene_, segment_from(place, sight.w, sight.distance), way.inside, sent, {way.random, light.bounces + 1},
        [&](FrameSet open, const Spectrum& transmittance) {
          for (const FrameFactor& part : parts)
            for_each_strand(
                out_.strands.of(light.strands), part.frames & open, [&](FrameSet frames, const Spectrum& weight) {
                  if (!frames.empty())
                    out_.splats.push_back({sight.film, frames,
                                           scene_.palette->seen(part.factor * weight * transmittance), light_index_,
                                           is_caught(scene_, place), light.medium != kNoMedium});
                });
        });
  }

  const VcmPass& pass_;
  const Scene& scene_;
  const PhotonStarts& starts_;
  LightTrace& out_;
  BranchingPath<LightPath> branches_;
  // Of the path that is being followed.
  const Light* light_ = nullptr;
  const SceneLight* scene_light_ = nullptr;
  int light_index_ = 0;
  Emission emission_;
};

void clear(LightTrace& trace, const StrandTable& of_lights) {
  trace.vertices.clear();
  trace.ends.clear();
  trace.on_curves.clear();
  trace.splats.clear();
  trace.strands = of_lights;
  trace.paths = {}, trace.stored = {}, trace.rejections = {};
}

}  // namespace

void LightSubpaths::trace(const VcmPass& pass) {
  const PhotonStarts starts(pass.scene, pass.settings.share_paths);
  traces_.resize(static_cast<std::size_t>(chunk_count(pass.settings.photons, kPathsPerChunk)));
  parallel_chunks(pass.settings.photons, kPathsPerChunk, [&](std::int64_t begin, std::int64_t end) {
    LightTrace& trace = traces_[static_cast<std::size_t>(begin / kPathsPerChunk)];
    clear(trace, starts.strands());
    LightPathTracer tracer(pass, starts, trace);
    for (std::int64_t i = begin; i < end; ++i) tracer.trace(static_cast<std::uint64_t>(i));
  });
}

std::span<const LightVertex> LightSubpaths::of(std::uint64_t index, const StrandTable*& strands) const {
  const LightTrace& trace = traces_[static_cast<std::size_t>(index / kPathsPerChunk)];
  const auto path = static_cast<std::size_t>(index % kPathsPerChunk);
  const std::size_t begin = path == 0 ? 0 : trace.ends[path - 1];
  strands = &trace.strands;
  return std::span(trace.vertices).subspan(begin, trace.ends[path] - begin);
}

void LightSubpaths::account(Statistics& statistics) const {
  for (const LightTrace& trace : traces_) {
    statistics.photon += trace.paths;
    statistics.photons_stored += trace.stored;
    statistics.rejections += trace.rejections;
  }
}

std::size_t LightSubpaths::bytes() const {
  std::size_t sum = 0;
  for (const LightTrace& trace : traces_)
    sum += trace.vertices.capacity() * sizeof(LightVertex) + trace.ends.capacity() * sizeof(std::size_t) +
           trace.on_curves.capacity() * sizeof(CurvePhoton) + trace.splats.capacity() * sizeof(Splat) +
           trace.strands.bytes();
  return sum;
}

}  // namespace dspm
