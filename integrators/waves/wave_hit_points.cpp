#include "dspm/integrators/waves/wave_hit_points.h"

#include <algorithm>
#include <tuple>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/hit_point_light.h"
#include "dspm/integrators/photons/hit_point_writer.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/waves/camera_wave.h"
#include "dspm/integrators/waves/follow_waves.h"
#include "dspm/integrators/waves/plain_objects.h"

namespace dspm {
namespace {

/// The waves of one tile, and what they leave.
class WavesOfTile {
 public:
  WavesOfTile(const Scene& scene, const PlainScene& plain, const RenderSettings& render,
              const HitPointSettings& settings, HitPointTile& tile)
      : scene_(scene),
        plain_(plain),
        render_(render),
        settings_(settings),
        tile_(tile),
        out_(scene, settings, tile),
        light_(scene, render, settings, out_),
        wave_{settings.max_depth, settings.least_alpha, settings.keep_bsdf, may_hide_photons(scene, settings)} {}

  void start(int x, int y, std::uint64_t iteration) {
    start_camera_paths(
        scene_, render_, x, y, iteration, settings_.frames, [&](const CameraPath& path) { start(path); },
        [&](const CameraPath& path) { out_.reject(path, path.frames, {SceneElement::Kind::camera}); });
    ++tile_.paths.paths;
  }

  void trace(std::uint64_t shuffle) {
    follow_waves(next_, shuffle, [&](const CameraState& path) { step(plain_, plain_.query, wave_, path, *this); });
    std::ranges::sort(sights_, {}, [](const WaveSight& s) {
      return std::tuple(s.path.start, s.path.bounces, s.kind, s.path.frames.lowest());
    });
    std::ranges::sort(hit_points_, {},
                      [](const WaveHitPoint& h) { return std::tuple(h.start, h.bounces, h.frames.lowest()); });
    for (const WaveSight& sight : sights_) show(sight);
    for (const WaveHitPoint& hit : hit_points_) keep(hit);
    tile_.paths.dynamic_paths += static_cast<std::uint64_t>(std::ranges::count(parted_, true));
  }

  // What a step leaves, see step().
  void segment(const CameraState& path, const HitPartition& parts) {
    tile_.paths.segments.add(path.frames.count());
    if (parts.size() > 1 || path.frames != scene_.frames()) parted_[started_[path.start].path] = true;
  }
  void see(const WaveSight& sight) { sights_.push_back(sight); }
  void store(const WaveHitPoint& hit) { hit_points_.push_back(hit); }
  void push(const CameraState& path) { next_.push_back(path); }
  void reject_shape(const CameraState& path, int shape) {
    out_.reject(started_[path.start].as, path.frames, {SceneElement::Kind::shape, shape});
  }
  void reject_material(const CameraState& path, int material) {
    out_.reject(started_[path.start].as, path.frames, {SceneElement::Kind::material, material});
  }

 private:
  /// How a path has started; those of one pixel, which the camera's states start, count as one.
  struct Started {
    CameraPath as;
    std::size_t path;  // counts from 0 within the tile
  };

  void start(const CameraPath& path) {
    next_.push_back({.ray = path.ray,
                     .throughput = path.throughput,
                     .frames = path.frames,
                     .eta_scale = path.eta_scale,
                     .length = path.length,
                     .from = path.from,
                     .from_ng = path.from_ng,
                     .pdf_w = path.pdf_w,
                     .random = path.random,
                     .start = static_cast<std::uint32_t>(started_.size()),
                     .bounces = 0,
                     .caught = path.caught});
    started_.push_back({path, tile_.paths.paths});
    parted_.resize(tile_.paths.paths + 1);
  }

  void show(const WaveSight& sight) {
    const CameraState& state = sight.path;
    CameraPath path = started_[state.start].as;
    path.ray = state.ray, path.throughput = state.throughput, path.frames = state.frames;
    path.bounces = state.bounces, path.eta_scale = state.eta_scale, path.length = state.length;
    path.from = state.from, path.from_ng = state.from_ng, path.pdf_w = state.pdf_w, path.caught = state.caught;
    if (sight.kind == WaveSight::Kind::escape) return light_.meet_infinity(path, path.frames);
    Vertex vertex(scene_, path.ray, sight.at);
    vertex.point.wavelength = path.wavelength;
    if (sight.kind == WaveSight::Kind::emission) return light_.meet_surface(path, vertex);
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      const HitPointLight::Surface surface{frames, &bsdf, sight.choice};
      light_.add(path, vertex, {&surface, 1});
    });
  }

  void keep(const WaveHitPoint& hit) {
    CameraPath path = started_[hit.start].as;
    path.throughput = hit.throughput, path.frames = hit.frames, path.bounces = hit.bounces;
    path.length = hit.length, path.caught = hit.caught;
    const HitPointWriter::EndSurface surface{hit.point, hit.point.ns, hit.wo, hit.shape};
    std::vector<HitPoint>& kept = hit.glossy ? tile_.glossy : tile_.hit_points;
    if (hit.constant) return out_.add_hit_point(kept, path, surface, nullptr, hit.lobes);
    BsdfSlot slot;
    const PlainMaterial& material = plain_.materials[plain_.shapes[hit.shape].material];
    out_.add_hit_point(kept, path, surface, &material.with_bsdf(hit.point, IntoSlot{slot}), hit.lobes);
  }

  const Scene& scene_;
  const PlainScene& plain_;
  const RenderSettings& render_;
  const HitPointSettings& settings_;
  HitPointTile& tile_;
  HitPointWriter out_;
  HitPointLight light_;
  CameraWave wave_;
  std::vector<Started> started_;
  std::vector<bool> parted_;  // by path: it has met something that differs between frames
  std::vector<CameraState> next_;
  std::vector<WaveSight> sights_;
  std::vector<WaveHitPoint> hit_points_;
};

}  // namespace

std::string why_not_in_waves(const Scene& scene, const HitPointSettings& settings) {
  if (settings.sample_direct || settings.light_media || (settings.direct != nullptr && settings.direct->scatters()))
    return "rays from hit points look for lights";
  if (settings.go_on) return "camera paths go on from hit points";
  if (std::string why = why_not_plain(scene); !why.empty()) return why;
  const bool averages = std::ranges::any_of(scene.materials, [&](const FrameStates<Material>& material) {
    return std::ranges::any_of(material.states, [&](const auto& state) {
      const auto plain = state.object->plain(*scene.palette);
      return state.object->averages() && plain && plain->averages();
    });
  });
  return averages ? "camera paths average textures over what they stand for" : "";
}

std::vector<HitPointTile> trace_hit_points_in_waves(const Scene& scene, const PlainScene& plain,
                                                    const RenderSettings& render, const HitPointSettings& settings,
                                                    std::uint64_t iteration, std::vector<HitPointTile> reuse,
                                                    std::uint64_t shuffle) {
  return trace_tiles(scene, render, settings, std::move(reuse), 1, [&](HitPointTile& tile, const auto& pixels) {
    WavesOfTile waves(scene, plain, render, settings, tile);
    for (const auto& [x, y] : pixels) waves.start(x, y, iteration);
    waves.trace(shuffle);
  });
}

}  // namespace dspm
