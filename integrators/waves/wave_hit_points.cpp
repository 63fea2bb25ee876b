#include "dspm/integrators/waves/wave_hit_points.h"

#include <algorithm>
#include <cstddef>
#include <memory>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/hit_point_light.h"
#include "dspm/integrators/photons/hit_point_writer.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/waves/camera_wave.h"
#include "dspm/integrators/waves/parts_of_waves.h"
#include "dspm/integrators/waves/plain_objects.h"

namespace dspm {
namespace {

/// What starts in one tile, and what waves leave there.
class TileOfWaves {
 public:
  TileOfWaves(const Scene& scene, const PlainScene& plain, const CameraWave& wave, const RenderSettings& render,
              const HitPointSettings& settings, HitPointTile& tile)
      : scene_(scene),
        plain_(plain),
        wave_(wave),
        render_(render),
        settings_(settings),
        tile_(tile),
        out_(scene, settings, tile),
        light_(scene, render, settings, out_) {}

  void start(int x, int y, std::uint64_t iteration) {
    start_camera_paths(
        scene_, render_, x, y, iteration, settings_.frames, [&](const CameraPath& path) { start(path); },
        [&](const CameraPath& path) { out_.reject(path, path.frames, {SceneElement::Kind::camera}); });
    ++tile_.paths.paths;
  }

  const std::vector<CameraState>& states() const { return states_; }
  std::uint32_t paths() const { return static_cast<std::uint32_t>(tile_.paths.paths); }

  void keep(const CameraWaves& waves, const PartRange& range) {
    for (const WaveSight& sight : range.of(waves.sights)) show(sight, started_[range.start(sight)]);
    for (const WaveHitPoint& hit : range.of(waves.hit_points)) keep(hit, started_[range.start(hit)]);
    for (const WaveRejection& rejection : range.of(waves.rejections))
      out_.reject(started_[range.start(rejection)], rejection.frames, element_of(rejection));
    tile_.paths.dynamic_paths += range.parted(waves);
  }

 private:
  void start(const CameraPath& path) {
    states_.push_back({.ray = path.ray,
                       .throughput = path.throughput,
                       .frames = path.frames,
                       .eta_scale = path.eta_scale,
                       .length = path.length,
                       .from = path.from,
                       .from_ng = path.from_ng,
                       .pdf_w = path.pdf_w,
                       .random = path.random,
                       .start = static_cast<std::uint32_t>(states_.size()),
                       .path = paths(),
                       .bounces = 0,
                       .caught = path.caught,
                       .alone = path.wavelength.alone,
                       .bodies = {path.inside, 0}});
    started_.push_back(path);
  }

  void show(const WaveSight& sight, const CameraPath& started) {
    const CameraState& state = sight.path;
    CameraPath path = started;
    path.ray = state.ray, path.throughput = state.throughput, path.frames = state.frames;
    path.bounces = state.bounces, path.eta_scale = state.eta_scale, path.length = state.length;
    path.from = state.from, path.from_ng = state.from_ng, path.pdf_w = state.pdf_w, path.caught = state.caught;
    path.wavelength.alone = state.alone, path.inside = state.bodies.inside;
    if (sight.kind == WaveSight::Kind::escape) return light_.meet_infinity(path, path.frames);
    Vertex vertex(scene_, path.ray, sight.at);
    vertex.point.wavelength = path.wavelength;
    const PlainIndex& outside = plain_.index_around(sight.at.hit, path.inside);
    vertex.point.outside_eta = outside.mean;
    vertex.point.outside_dispersion = outside.at(path.wavelength) / outside.mean;
    if (sight.kind == WaveSight::Kind::emission) return light_.meet_surface(path, vertex);
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      const HitPointLight::Surface surface{frames, &bsdf, sight.choice};
      light_.add(path, vertex, {&surface, 1});
    });
  }

  void keep(const WaveHitPoint& hit, const CameraPath& started) {
    CameraPath path = started;
    path.throughput = hit.throughput, path.frames = hit.frames, path.bounces = hit.bounces;
    path.length = hit.length, path.caught = hit.caught, path.wavelength.alone = hit.alone;
    path.inside = hit.inside;
    const HitPointWriter::EndSurface surface{hit.point, hit.point.ns, hit.wo, hit.hit};
    std::vector<HitPoint>& kept = hit.glossy ? tile_.glossy : tile_.hit_points;
    if (hit.constant) return out_.add_hit_point(kept, path, surface, nullptr, hit.lobes);
    BsdfSlot slot;
    const PlainMaterial& material = plain_.materials[plain_.place_of_material(hit.hit, hit.inside)];
    out_.add_hit_point(kept, path, surface,
                       &material.with_bsdf(hit.point, wave_.wavelength.of_path(hit.alone), IntoSlot{slot}), hit.lobes);
  }

  const Scene& scene_;
  const PlainScene& plain_;
  const CameraWave& wave_;
  const RenderSettings& render_;
  const HitPointSettings& settings_;
  HitPointTile& tile_;
  HitPointWriter out_;
  HitPointLight light_;
  std::vector<CameraState> states_;
  std::vector<CameraPath> started_;
};

}  // namespace

std::string why_not_by_settings(const Scene& scene, const HitPointSettings& settings) {
  if (settings.sample_direct || settings.light_media || (settings.direct != nullptr && settings.direct->scatters()))
    return "rays from hit points look for lights";
  if (settings.go_on) return "camera paths go on from hit points";
  if (looks_differ(scene)) return "materials differ between frames";
  const bool averages = std::ranges::any_of(scene.materials, [&](const FrameStates<Material>& material) {
    return std::ranges::any_of(material.states, [&](const auto& state) {
      const auto plain = state.object->plain(*scene.palette);
      return state.object->averages() && plain && plain->averages();
    });
  });
  return averages ? "camera paths average textures over what they stand for" : "";
}

std::string why_not_in_waves(const Scene& scene, const HitPointSettings& settings) {
  const std::string why = why_not_by_settings(scene, settings);
  return why.empty() ? why_not_plain(scene) : why;
}

std::vector<HitPointTile> trace_hit_points_in_waves(const Scene& scene, const PlainScene& plain, WaveTracer& tracer,
                                                    const RenderSettings& render, const HitPointSettings& settings,
                                                    std::uint64_t iteration, std::vector<HitPointTile> reuse) {
  const HuedWavelength wavelength({.nm = scene.nm_of(render.seed, iteration), .weighs = true});
  const CameraWave wave{settings.max_depth, settings.least_alpha, settings.keep_bsdf, may_hide_photons(scene, settings),
                        wavelength};
  reuse.resize(hit_point_tile_count(render.crop));
  const auto make = [&](std::size_t t) {
    reuse[t].start(*scene.palette);
    auto tile = std::make_unique<TileOfWaves>(scene, plain, wave, render, settings, reuse[t]);
    for (const auto& [x, y] : pixels_of_hit_point_tile(render, settings, t)) tile->start(x, y, iteration);
    return tile;
  };
  const std::size_t paths_of_tile = static_cast<std::size_t>(render.crop.count()) / reuse.size() + 1;
  const std::size_t at_once = std::max<std::size_t>(1, tracer.paths_at_once() / paths_of_tile);
  for (std::size_t t = 0; t < reuse.size(); t += at_once) {
    PartsOfWaves<TileOfWaves, CameraState> parts(t, std::min(t + at_once, reuse.size()), make);
    const CameraWaves waves = tracer.trace(wave, parts.starts(scene.frames()));
    parts.for_each([&](TileOfWaves& tile, const PartRange& range) { tile.keep(waves, range); });
    reuse[t].paths.segments += {waves.segments.done, waves.segments.separate};
  }
  return reuse;
}

}  // namespace dspm
