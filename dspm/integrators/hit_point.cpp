#include "dspm/integrators/hit_point.h"

#include <algorithm>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/direct_light.h"
#include "dspm/integrators/joint_path.h"
#include "dspm/integrators/parted_paths.h"
#include "dspm/integrators/tiles.h"
#include "dspm/math/frames.h"
#include "dspm/math/ray.h"
#include "dspm/math/vec.h"
#include "dspm/scene/scene.h"
#include "dspm/system/parallel.h"

namespace dspm {
namespace {

constexpr int kTileSide = 32;
// A few pixel spacings; never more than a share of the scene, for what is seen at the horizon.
constexpr float kRadiusInPixels = 4, kLargestShareOfScene = 0.05f;

/// How frames end in a hit point.
struct End {
  FrameSet frames;
  LobeChoice choice;
  bool constant;  // f is, and then stands here; else it is the bsdf's
  Rgb f;
  BsdfSlot bsdf;

  std::optional<Rgb> along(const End& first) const {
    if (constant != first.constant || choice.lobes != first.choice.lobes) return std::nullopt;
    if (constant) return f / choice.chance;
    const auto ratio = this == &first ? Rgb(1) : bsdf->ratio_to(*first.bsdf, choice.lobes);
    // Where a black f has photons all the same, hj09 counts them.
    if (!ratio || !(std::min({ratio->r, ratio->g, ratio->b}) > 0)) return std::nullopt;
    return *ratio / choice.chance;
  }
};

class HitPointTracer {
 public:
  HitPointTracer(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings, HitPointTile& out)
      : scene_(scene),
        render_(render),
        settings_(settings),
        frames_(scene.frames()),
        has_hidden_(std::any_of(scene.lights.begin(), scene.lights.end(),
                                [](const SceneLight& light) { return light.is_delta; })),
        out_(out) {}

  /// x, y in the full image. What frames meet apart from others waits for finish().
  void trace(int x, int y, std::uint64_t iteration) {
    const PathRandom random(render_.seed, Stream::camera, camera_path_index(render_, x, y), iteration);
    pixel_ = pixel_in_crop(render_.crop, x, y);
    const Vec2 film = film_point(render_, x, y, random);
    scene_.camera.for_each(frames_, [&](FrameSet frames, const Camera& camera) {
      camera_ = &camera;
      const Ray ray = camera.ray(film, random.pair(0, kLightDirection));
      if (!is_finite(ray)) return reject(frames, {ScenePart::Kind::camera});
      stack_.push({ray, Rgb(1), frames});
      run(random);
    });
    ++out_.paths.paths;
    out_.paths.dynamic_paths += met_dynamic_;
    met_dynamic_ = false;
  }

  void finish() {
    finishing_ = true;
    parted_.for_each([&](const PartedPath& from, const FrameHit& part) {
      pixel_ = from.pixel, camera_ = from.camera;
      follow(from.path, part, from.random);
      run(from.random);
    });
  }

 private:
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
      parted_.add({path, random, camera_, pixel_}, parts);
    }
  }

  void follow(const PathState& path, const FrameHit& part, const PathRandom& random) {
    if (part.hit.missed()) {
      for_each_escape(scene_, part.frames, path.ray.direction,
                      [&](FrameSet frames, const Rgb& radiance, const SceneLight& light, const Light&) {
                        see(path, frames, radiance, [&] { return light_part(scene_, light); });
                      });
      return;
    }
    met_ = &part.hit;
    const Vec3 wo = -path.ray.direction;
    const SurfacePoint point = scene_.surface_point(part.hit);
    if (!is_finite(point)) return reject(part.frames, shape_part(part.hit));
    for_each_emission(scene_, part, point, wo, [&](FrameSet frames, const Rgb& radiance, const Light&) {
      see(path, frames, radiance, [&] { return emitter_part(scene_, part.hit); });
    });
    if (path.bounces >= settings_.max_depth) return;
    PathState arrived = path;
    arrived.length += part.hit.t, arrived.frames = part.frames;
    if (material_at(scene_, part.hit).differs_in(part.frames)) return follow_together(arrived, part, point, wo, random);
    for_each_surface(scene_, part, point, [&](FrameSet frames, const Bsdf& bsdf) {
      arrived.frames = frames;
      const LobeChoice choice = choose_lobes(bsdf, wo, settings_.least_alpha, random, path.bounces);
      if (choice.rough) {
        end(arrived, point, bsdf, wo, choice, random, [&](const std::optional<Rgb>& constant) {
          const FrameFactor f{frames, constant.value_or(Rgb(1)) / choice.chance};
          add_hit_point(out_.hit_points, arrived, {&f, 1}, point, wo, constant ? nullptr : &bsdf, choice.lobes);
        });
      } else {
        go_on(arrived, point, bsdf, wo, choice, random, [&](const BsdfSample& sample) {
          const FrameFactor f{frames, sample.weight / choice.chance};
          push(arrived, {&f, 1}, point, sample, random);
        });
      }
    });
  }

  /// Where the material differs between the frames.
  [[gnu::noinline]] void follow_together(const PathState& path, const FrameHit& part, const SurfacePoint& point,
                                         const Vec3& wo, const PathRandom& random) {
    FrameArray<End> ends;
    FrameArray<Way> ways;
    for_each_surface(scene_, part, point, [&](FrameSet frames, const Bsdf& bsdf) {
      PathState branch = path;
      branch.frames = frames;
      met_dynamic_ = true;
      const LobeChoice choice = choose_lobes(bsdf, wo, settings_.least_alpha, random, path.bounces);
      if (choice.rough)
        end(branch, point, bsdf, wo, choice, random, [&](const std::optional<Rgb>& constant) {
          ends.add({frames, choice, constant.has_value(), constant.value_or(Rgb()), BsdfSlot::copy_of(bsdf)});
        });
      else
        go_on(branch, point, bsdf, wo, choice, random, [&](const BsdfSample& sample) {
          ways.add({frames, sample.weight / choice.chance, sample, false});
        });
    });
    // Frames whose scattering functions are multiples of one another have a hit point in common.
    for_each_joint(ends, settings_.share_paths, [&](const End& first, std::span<const FrameFactor> factors) {
      add_hit_point(out_.hit_points, path, factors, point, wo, first.constant ? nullptr : &*first.bsdf,
                    first.choice.lobes);
    });
    for_each_joint(ways, settings_.share_paths, [&](const Way& first, std::span<const FrameFactor> factors) {
      push(path, factors, point, first.sample, random);
    });
  }

  /// Calls fn(f where it is constant) unless nothing can be gathered.
  template <class Fn>
  void end(const PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const LobeChoice& choice,
           const PathRandom& random, Fn&& fn) {
    if (settings_.sample_direct)
      add_direct_light(path, point, bsdf, wo, choice.lobes, choice.chance, random, [](float) { return 1.f; });
    std::optional<Rgb> constant;
    if (!settings_.keep_bsdf) constant = bsdf.lambertian(choice.lobes);
    if (!constant || !is_black(*constant)) fn(constant);
  }

  /// `bsdf`: null where f is constant and among the factors.
  void add_hit_point(std::vector<HitPoint>& hit_points, const PathState& path, std::span<const FrameFactor> factors,
                     const SurfacePoint& point, const Vec3& wo, const Bsdf* bsdf, LobeSet lobes) {
    PathState ended = path;
    const auto keep = [&](StrandList, FrameSet frames, const Rgb&, const Rgb& after) {
      return if_finite(after, frames);
    };
    if (!multiply(ended, factors, out_.strands, ByRatio::yes, keep)) return;
    HitPoint& hit = hit_points.emplace_back();
    hit.p = point.p;
    hit.ng = dot(wo, point.ng) < 0 ? -point.ng : point.ng;
    hit.throughput = ended.throughput, hit.strands = ended.strands;
    hit.frames = ended.frames, hit.pixel = pixel_;
    hit.radius = radius(ended.length);
    out_.paths.weighted += ended.strands != 0;
    if (bsdf == nullptr) return;
    hit.scattering = static_cast<int>(out_.scatterings.size());
    out_.scatterings.push_back(
        {BsdfSlot::copy_of(*bsdf), wo, point.p_error, lobes, bsdf->transmits(lobes), material().index});
  }

  /// Calls fn(const BsdfSample&) unless the frames end.
  template <class Fn>
  void go_on(const PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
             const LobeChoice& choice, const PathRandom& random, Fn&& fn) {
    // No ray that follows a lobe finds a point, spot or distant light: a shadow ray does, or, where its light came
    // through specular lobes, the photons that are kept for this.
    if (const LobeSet glossy = choice.lobes & glossy_lobes(bsdf, settings_.least_alpha)) {
      add_direct_light(path, point, bsdf, wo, glossy, choice.chance, random,
                       [](float pdf_w) { return pdf_w > 0 ? 0.f : 1.f; });
      const FrameFactor f{path.frames, Rgb(1 / choice.chance)};
      if (has_hidden_) add_hit_point(out_.glossy, path, {&f, 1}, point, wo, &bsdf, glossy);
    }
    const auto sample = sample_bsdf(bsdf, wo, random, path.bounces, Transport::radiance, choice.lobes);
    if (!sample) return;
    if (!is_finite(sample->wi)) return reject(path.frames, material());
    fn(*sample);
  }

  void push(const PathState& path, std::span<const FrameFactor> factors, const SurfacePoint& point,
            const BsdfSample& sample, const PathRandom& random) {
    PathState& branch = stack_.push(path);
    move_on(branch, point, sample);
    const float u = random.number(path.bounces, kRoulette);
    const auto roulette = [&](StrandList, FrameSet frames, const Rgb&, const Rgb& product) {
      const Rgb after = if_finite(product, frames);
      const float p = roulette_chance(after, branch.eta_scale, path.bounces);
      return p >= 1 ? after : u < p ? after * (1 / p) : Rgb();
    };
    const ByRatio by_ratio = path.bounces < kFirstRouletteBounce ? ByRatio::yes : ByRatio::no;
    if (!multiply(branch, factors, out_.strands, by_ratio, roulette)) stack_.drop();
  }

  template <class Weight>
  void add_direct_light(const PathState& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                        LobeSet lobes, float chance, const PathRandom& random, Weight&& weight) {
    sample_direct_light(
        scene_, path.frames, *met_, point, bsdf, wo, lobes, random, path.bounces + 1, out_.paths.shadow_rays,
        [&](const Vec3&, float pdf_w) { return weight(pdf_w); },
        [&](FrameSet frames, const Rgb& radiance, auto&& giver) { see(path, frames, radiance / chance, giver); });
  }

  /// `giver`: who is at fault where it is not finite.
  template <class WhoGave>
  void see(const PathState& path, FrameSet frames, const Rgb& radiance, WhoGave&& giver) {
    for_each_strand(out_.strands.of(path.strands), frames, [&](FrameSet alike, const Rgb& weight) {
      const Rgb seen = path.throughput * weight * radiance;
      if (!is_finite(seen)) return reject(alike, giver());
      out_.seen.push_back({pixel_, alike, seen});
    });
  }
  void reject(FrameSet frames, const ScenePart& giver) { out_.rejections.add(giver, frames, pixel_); }
  ScenePart material() const { return material_part(scene_, *met_); }
  Rgb if_finite(const Rgb& carried, FrameSet frames) {
    if (is_finite(carried)) return carried;
    reject(frames, material());
    return {};
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
  bool has_hidden_;  // there may be hidden photons to be found
  HitPointTile& out_;
  const Camera* camera_ = nullptr;
  PathStack<> stack_;
  PartedPaths parted_;
  bool finishing_ = false;
  const RayHit* met_ = nullptr;  // where the path just now has arrived
  int pixel_ = 0;
  bool met_dynamic_ = false;
};

void clear(HitPointTile& tile) {
  tile.hit_points.clear();
  tile.glossy.clear();
  tile.scatterings.clear();
  tile.strands.clear();
  tile.seen.clear();
  tile.paths = {}, tile.rejections = {};
}

}  // namespace

void account(const std::vector<HitPointTile>& tiles, Statistics& statistics) {
  for (const HitPointTile& tile : tiles) statistics.camera += tile.paths, statistics.rejections += tile.rejections;
}

std::size_t bytes_of(const std::vector<HitPointTile>& tiles) {
  std::size_t sum = 0;
  for (const HitPointTile& tile : tiles)
    sum += (tile.hit_points.capacity() + tile.glossy.capacity()) * sizeof(HitPoint) +
           tile.scatterings.capacity() * sizeof(Scattering) + tile.seen.capacity() * sizeof(SeenLight) +
           tile.strands.bytes();
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
