#include "integrators/hit_point.h"

#include <algorithm>

#include "core/parallel.h"
#include "integrators/direct_light.h"
#include "integrators/tiles.h"

namespace dspm {
namespace {

constexpr int kTileSide = 32;
// A few pixel spacings; never more than a share of the scene, for what is seen at the horizon.
constexpr float kRadiusInPixels = 4, kLargestShareOfScene = 0.05f;
// What is rougher is no specular lobe.
constexpr float kLeastRoughness = 1e-4f;

class HitPointTracer {
 public:
  HitPointTracer(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings, HitPointTile& out)
      : scene_(scene), render_(render), settings_(settings), frames_(scene.frames()), out_(out) {}

  /// x, y in the full image. What frames meet apart from others waits for finish().
  void trace(int x, int y, std::uint64_t iteration) {
    const PathRandom random(render_.seed, Stream::camera, camera_path_index(render_, x, y), iteration);
    pixel_ = pixel_in_crop(render_.crop, x, y);
    const Vec2 film = film_point(render_, x, y, random);
    scene_.camera.for_each(frames_, [&](FrameSet frames, const Camera& camera) {
      camera_ = &camera;
      stack_.push({camera.ray(film, random.pair(0, kLightDirection)), Rgb(1), frames});
      run(random);
    });
    ++out_.paths.paths;
    out_.paths.dynamic_paths += met_dynamic_;
    met_dynamic_ = false;
  }

  /// Follows what waits, frame by frame: what is dynamic has its own vertices and tree in each frame, and a tile's
  /// paths in one frame find them in the cache.
  void finish() {
    finishing_ = true;
    std::stable_sort(waiting_.begin(), waiting_.end(), [](const Waiting& a, const Waiting& b) {
      return a.part.frames.lowest() < b.part.frames.lowest();
    });
    for (const Waiting& w : waiting_) {
      const Parted& from = parted_[w.parted];
      pixel_ = from.pixel, camera_ = from.camera;
      follow(from.path, w.part, from.random);
      run(from.random);
    }
  }

 private:
  /// A path at whose end frames part.
  struct Parted {
    PathState path;
    PathRandom random;
    const Camera* camera;
    int pixel;
  };
  struct Waiting {
    FrameHit part;
    std::uint32_t parted;  // number of the path
  };

  void run(const PathRandom& random) {
    while (!stack_.empty()) {
      const PathState path = stack_.pop();
      met_dynamic_ |= path.frames != frames_;
      const HitPartition parts = scene_.accel->partition(path.ray, path.frames);
      out_.paths.segments.add(path.frames.count());
      if (parts.size() == 1 || finishing_) {
        for (const FrameHit& part : parts) follow(path, part, random);
        continue;
      }
      met_dynamic_ = true;
      for (const FrameHit& part : parts) waiting_.push_back({part, static_cast<std::uint32_t>(parted_.size())});
      parted_.push_back({path, random, camera_, pixel_});
    }
  }

  void follow(const PathState& path, const FrameHit& part, const PathRandom& random) {
    if (part.hit.missed()) {
      for_each_escape(scene_, part.frames, path.ray.direction,
                      [&](FrameSet frames, const Rgb& radiance, const SceneLight&, const Light&) {
                        see(frames, path.throughput * radiance);
                      });
      return;
    }
    const Vec3 wo = -path.ray.direction;
    const float length = path.length + part.hit.t;
    for_each_surface(scene_, part, [&](FrameSet frames, const SurfacePoint& point, const Bsdf& bsdf) {
      for_each_emission(scene_, {frames, part.hit}, point, wo,
                        [&](FrameSet lit, const Rgb& radiance, const Light&) { see(lit, path.throughput * radiance); });
      met_dynamic_ |= frames != frames_;
      PathState branch = path;
      branch.frames = frames;
      branch.length = length;
      scatter(branch, point, bsdf, wo, random);
    });
  }

  /// Ends the path in a hit point, or follows a lobe that is too smooth to gather on.
  void scatter(PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const PathRandom& random) {
    if (path.bounces >= settings_.max_depth) return;
    const int bounce = path.bounces;
    const LobeChoice choice = choose_lobes(bsdf, wo, settings_.least_alpha, random, bounce);
    path.throughput *= 1 / choice.chance;
    if (choice.rough) return end(path, point, bsdf, wo, choice.lobes, random);
    // No ray that follows a lobe finds a point, spot or distant light; no photon is gathered here that could come from
    // it.
    if (const auto glossy = static_cast<LobeSet>(choice.lobes & bsdf.lobes(kLeastRoughness)))
      add_direct_light(path, point, bsdf, wo, glossy, random, [](float pdf_w) { return pdf_w > 0 ? 0.f : 1.f; });
    const auto sample = sample_bsdf(bsdf, wo, random, bounce, Transport::radiance, choice.lobes);
    if (!sample) return;
    extend(path, point, *sample);
    if (is_black(path.throughput)) return;
    if (!is_finite(path.throughput)) return reject(path.frames);
    if (!survives(path, roulette_chance(path, bounce), random.number(bounce, kRoulette))) return;
    stack_.push(path);
  }

  void end(const PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, LobeSet lobes,
           const PathRandom& random) {
    if (settings_.sample_direct) add_direct_light(path, point, bsdf, wo, lobes, random, [](float) { return 1.f; });
    std::optional<Rgb> constant;
    if (!settings_.keep_bsdf) constant = bsdf.lambertian(lobes);
    if (constant && is_black(*constant)) return;
    HitPoint& hit = out_.hit_points.emplace_back();
    hit.p = point.p;
    hit.ng = dot(wo, point.ng) < 0 ? -point.ng : point.ng;
    hit.throughput = constant ? path.throughput * *constant : path.throughput;
    hit.frames = path.frames, hit.pixel = pixel_;
    hit.radius = radius(path.length);
    if (constant) return;
    hit.scattering = static_cast<int>(out_.scatterings.size());
    out_.scatterings.push_back({BsdfSlot::copy_of(bsdf), wo, point.p_error, lobes, bsdf.transmits(lobes)});
  }

  template <class Weight>
  void add_direct_light(const PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                        LobeSet lobes, const PathRandom& random, Weight&& weight) {
    sample_direct_light(
        scene_, path.frames, point, bsdf, wo, lobes, random, path.bounces + 1, out_.paths.shadow_rays,
        [&](const Vec3&, float pdf_w) { return weight(pdf_w); },
        [&](FrameSet frames, const Rgb& radiance) { see(frames, path.throughput * radiance); });
  }

  void see(FrameSet frames, const Rgb& radiance) {
    if (!is_finite(radiance)) return reject(frames);
    out_.seen.push_back({pixel_, frames, radiance});
  }
  void reject(FrameSet frames) { out_.invalid += static_cast<std::uint64_t>(frames.count()); }

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
  std::vector<Parted> parted_;
  std::vector<Waiting> waiting_;
  bool finishing_ = false;
  int pixel_ = 0;
  bool met_dynamic_ = false;
};

void clear(HitPointTile& tile) {
  tile.hit_points.clear();
  tile.scatterings.clear();
  tile.seen.clear();
  tile.paths = {}, tile.invalid = 0;
}

}  // namespace

void account(const std::vector<HitPointTile>& tiles, Statistics& statistics) {
  for (const HitPointTile& tile : tiles) statistics.camera += tile.paths, statistics.invalid += tile.invalid;
}

std::size_t bytes_of(const std::vector<HitPointTile>& tiles) {
  std::size_t sum = 0;
  for (const HitPointTile& tile : tiles)
    sum += tile.hit_points.capacity() * sizeof(HitPoint) + tile.scatterings.capacity() * sizeof(Scattering) +
           tile.seen.capacity() * sizeof(SeenLight);
  return sum;
}

std::vector<HitPointTile> trace_hit_points(const Scene& scene, const RenderSettings& render,
                                           const HitPointSettings& settings, std::uint64_t iteration,
                                           std::vector<HitPointTile> reuse) {
  reuse.resize(static_cast<std::size_t>(tile_count(render.crop, kTileSide)));
  parallel_for(static_cast<std::int64_t>(reuse.size()), 1, [&](std::int64_t t) {
    HitPointTile& tile = reuse[static_cast<std::size_t>(t)];
    clear(tile);
    HitPointTracer tracer(scene, render, settings, tile);
    for_each_pixel_of_tile(render.crop, kTileSide, static_cast<int>(t),
                           [&](int x, int y) { tracer.trace(x, y, iteration); });
    tracer.finish();
  });
  return reuse;
}

}  // namespace dspm
