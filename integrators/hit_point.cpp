#include "integrators/hit_point.h"

#include "core/parallel.h"
#include "integrators/direct_light.h"
#include "integrators/tiles.h"

namespace dspm {
namespace {

constexpr int kTileSide = 16;
// A few pixel spacings; never more than a share of the scene, for what is seen at the horizon.
constexpr float kRadiusInPixels = 4, kLargestShareOfScene = 0.05f;
constexpr int kFirstRouletteBounce = 4;

class HitPointTracer {
 public:
  HitPointTracer(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings, FrameSet frames,
                 HitPointTile& out)
      : scene_(scene), render_(render), settings_(settings), frames_(frames), out_(out) {}

  /// x, y in the full image.
  void trace(int x, int y, std::uint64_t iteration) {
    const PathRandom random(render_.seed, Stream::camera, camera_path_index(render_, x, y), iteration);
    pixel_ = pixel_in_crop(render_.crop, x, y);
    const Vec2 film = film_point(render_, x, y, random);
    scene_.camera.for_each(frames_, [&](FrameSet frames, const Camera& camera) {
      camera_ = &camera;
      stack_.push({camera.ray(film, random.pair(0, kLightDirection)), Rgb(1), frames, 0, 0, frames != frames_});
      run(random);
    });
    ++out_.paths.paths;
    out_.paths.dynamic_paths += met_dynamic_;
    met_dynamic_ = false;
  }

 private:
  void run(const PathRandom& random) {
    while (!stack_.empty()) {
      const PathState path = stack_.pop();
      met_dynamic_ |= path.dynamic;
      const HitPartition parts = scene_.accel->partition(path.ray, path.frames);
      out_.paths.segments.add(path.frames.count());
      for (const FrameHit& part : parts) follow(path, part, random);
    }
  }

  void follow(const PathState& path, const FrameHit& part, const PathRandom& random) {
    if (part.hit.missed()) {
      for_each_escape(scene_, part.frames, path.ray.direction,
                      [&](FrameSet frames, const Rgb& radiance, const SceneLight&, const Light&) {
                        out_.seen.push_back({pixel_, frames, path.throughput * radiance});
                      });
      return;
    }
    met_dynamic_ |= !scene_.shapes[static_cast<std::size_t>(part.hit.shape)].frames.contains(frames_);
    const Vec3 wo = -path.ray.direction;
    const float length = path.length + part.hit.t;
    for_each_surface(scene_, part, [&](FrameSet frames, const SurfacePoint& point, const Bsdf& bsdf) {
      for_each_emission(scene_, {frames, part.hit}, point, wo, [&](FrameSet lit, const Rgb& radiance, const Light&) {
        out_.seen.push_back({pixel_, lit, path.throughput * radiance});
      });
      PathState branch = path;
      branch.frames = frames;
      branch.length = length;
      scatter(branch, point, bsdf, wo, random);
    });
  }

  /// Ends the path in a hit point, or follows a lobe that is too smooth to gather on.
  void scatter(PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const PathRandom& random) {
    if (path.bounces >= settings_.max_depth) return;
    const LobeSet all = bsdf.all_lobes(), rough = bsdf.lobes(settings_.least_alpha);
    const LobeSet smooth = static_cast<LobeSet>(all & ~rough);
    const int bounce = path.bounces;
    const float gathers = rough == 0 ? 0 : smooth == 0 ? 1 : bsdf.share(wo, rough);
    if (random.number(bounce, kSplit) < gathers) {
      path.throughput *= 1 / gathers;
      return end(path, point, bsdf, wo, rough, random);
    }
    if (smooth == 0) return;
    const Vec2 u = random.pair(bounce, kScatter);
    const auto sample = bsdf.sample(wo, {u.x, u.y, random.number(bounce, kLobe)}, Transport::radiance, smooth);
    if (!sample) return;
    extend(path, point, *sample);
    path.throughput *= 1 / (1 - gathers);
    const float p = bounce < kFirstRouletteBounce ? 1 : std::min(1.f, max_component(path.throughput));
    if (!is_black(path.throughput) && is_finite(path.throughput) && survives(path, p, random.number(bounce, kRoulette)))
      stack_.push(path);
  }

  void end(const PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, LobeSet lobes,
           const PathRandom& random) {
    if (settings_.sample_direct)
      sample_direct_light(scene_, path.frames, point, bsdf, wo, lobes, random, path.bounces + 1, out_.paths.shadow_rays,
                          [](const Vec3&, float) { return 1.f; },
                          [&](FrameSet frames, const Rgb& radiance) {
                            out_.seen.push_back({pixel_, frames, path.throughput * radiance});
                          });
    std::optional<Rgb> constant;
    if (!settings_.keep_bsdf) constant = bsdf.lambertian(lobes);
    if (constant && is_black(*constant)) return;
    HitPoint& hit = out_.hit_points.emplace_back();
    hit.p = point.p, hit.p_error = point.p_error, hit.wo = wo;
    hit.ng = dot(wo, point.ng) < 0 ? -point.ng : point.ng;
    hit.throughput = constant ? path.throughput * *constant : path.throughput;
    hit.frames = path.frames, hit.pixel = pixel_;
    hit.radius = radius(path.length);
    hit.lobes = lobes, hit.lambertian = constant.has_value();
    if (!constant) hit.bsdf = BsdfSlot::copy_of(bsdf);
  }

  float radius(float path_length) const {
    if (settings_.radius > 0) return settings_.radius;
    return std::clamp(kRadiusInPixels * camera_->pixel_spacing(path_length), 1e-6f * scene_.radius,
                      kLargestShareOfScene * scene_.radius);
  }

  const Scene& scene_;
  const RenderSettings& render_;
  const HitPointSettings& settings_;
  FrameSet frames_;
  HitPointTile& out_;
  const Camera* camera_ = nullptr;
  PathStack<> stack_;
  int pixel_ = 0;
  bool met_dynamic_ = false;
};

void clear(HitPointTile& tile) {
  tile.hit_points.clear();
  tile.seen.clear();
  tile.paths = {};
}

}  // namespace

std::vector<HitPointTile> trace_hit_points(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings,
                                           FrameSet frames, std::uint64_t iteration, std::vector<HitPointTile> reuse) {
  reuse.resize(static_cast<std::size_t>(tile_count(render.crop, kTileSide)));
  parallel_for(static_cast<std::int64_t>(reuse.size()), 1, [&](std::int64_t t) {
    HitPointTile& tile = reuse[static_cast<std::size_t>(t)];
    clear(tile);
    HitPointTracer tracer(scene, render, settings, frames, tile);
    for_each_pixel_of_tile(render.crop, kTileSide, static_cast<int>(t), [&](int x, int y) { tracer.trace(x, y, iteration); });
  });
  return reuse;
}

}  // namespace dspm
