#include "dspm/integrators/hit_point.h"

#include <algorithm>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/balance.h"
#include "dspm/integrators/branching_path.h"
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
// A few pixel spacings, bounded by a fraction of the scene for points near the horizon.
constexpr float kRadiusInPixels = 4, kLargestShareOfScene = 0.05f;

/// How a path ends in a hit point in some of its frames.
struct End {
  FrameSet frames;
  LobeChoice choice;
  bool constant;  // whether f is, and so stored here; else the bsdf gives it
  Rgb f;
  BsdfSlot bsdf;

  std::optional<Rgb> along(const End& first) const {
    if (constant != first.constant || choice.lobes != first.choice.lobes) return std::nullopt;
    if (constant) return f / choice.chance;
    const auto ratio = this == &first ? Rgb(1) : bsdf->ratio_to(*first.bsdf, choice.lobes);
    // Even if f is black, hj09 counts the photons.
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
        has_hidden_(std::any_of(scene.lights.begin(), scene.lights.end(),
                                [](const SceneLight& light) { return light.is_delta; })),
        out_(out),
        branches_(scene, out.paths) {}

  /// x, y in the full image. Where frames part, their paths wait for finish().
  void trace(int x, int y, std::uint64_t iteration) {
    start_camera_paths(
        scene_, render_, x, y, iteration,
        [&](const CameraPath& path) {
          branches_.push(path);
          branches_.follow(*this);
        },
        [&](const CameraPath& path) { reject(path, path.frames, {SceneElement::Kind::camera}); });
    branches_.count_path();
  }

  void finish() {
    finishing_ = true;
    parted_.for_each([&](const CameraPath& path, const FrameHit& part) {
      branches_.arrive(path, part, *this);
      branches_.follow(*this);
    });
  }

 private:
  friend BranchingPath<CameraPath>;

  bool postpones(const CameraPath& path, const HitPartition& parts) {
    if (parts.size() == 1 || finishing_) return false;
    parted_.add(path, parts);
    return true;
  }

  void escaped(const CameraPath& path, FrameSet frames) {
    for_each_escape(scene_, frames, path.ray.direction,
                    [&](FrameSet lit, const Rgb& radiance, const SceneLight& scene_light, const Light& light) {
                      const float weight = path.only_looks ? weight_of_look(path, scene_light, light,
                                                                            {{path.from, -path.ray.direction}, {}, -1})
                                                           : weight_of_escape(scene_, path, scene_light, light);
                      see(path, lit, radiance * weight, [&] { return light_element(scene_, scene_light); });
                    });
  }

  void lost(const CameraPath& path, FrameSet frames, const SceneElement& giver) { reject(path, frames, giver); }

  void arrived(const CameraPath& path, const Vertex& vertex) {
    for_each_emission(scene_, vertex, vertex.frames, [&](FrameSet frames, const Rgb& radiance, const Light& light) {
      const SceneLight& scene_light = scene_.lights[static_cast<std::size_t>(vertex.shape.light)];
      const float weight = path.only_looks
                               ? weight_of_look(path, scene_light, light,
                                                {{vertex.point.p, vertex.wo}, vertex.point.ng, vertex.hit.primitive})
                               : weight_of_hit(scene_, path, vertex, light);
      see(path, frames, radiance * weight, [&] { return vertex.emitter_element(); });
    });
    if (path.only_looks || path.bounces >= settings_.max_depth) return;
    CameraPath arriving = path;
    arriving.length += vertex.hit.t, arriving.frames = vertex.frames;
    if (vertex.differs()) return scatter_together(arriving, vertex);
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      arriving.frames = frames;
      const LobeChoice choice = choose_lobes(bsdf, path, vertex.wo, settings_.least_alpha);
      if (choice.rough) {
        end(arriving, vertex, bsdf, choice, [&](const std::optional<Rgb>& constant) {
          const FrameFactor f{frames, constant.value_or(Rgb(1)) / choice.chance};
          add_hit_point(out_.hit_points, arriving, vertex, {&f, 1}, constant ? nullptr : &bsdf, choice.lobes);
        });
        sample_look(arriving, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          const FrameFactor f{frames, sample.weight / choice.chance};
          look(arriving, vertex, sample, {&f, 1});
        });
      } else {
        scatter(arriving, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          const FrameFactor f{frames, sample.weight / choice.chance};
          extend(arriving, vertex, sample, {&f, 1});
        });
      }
    });
  }

  /// For a material that differs between the frames.
  [[gnu::noinline]] void scatter_together(const CameraPath& path, const Vertex& vertex) {
    FrameArray<End> ends;
    FrameArray<Scattered> scattered, looks;
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      CameraPath branch = path;
      branch.frames = frames;
      const LobeChoice choice = choose_lobes(bsdf, path, vertex.wo, settings_.least_alpha);
      if (choice.rough) {
        end(branch, vertex, bsdf, choice, [&](const std::optional<Rgb>& constant) {
          ends.add({frames, choice, constant.has_value(), constant.value_or(Rgb()), BsdfSlot::copy_of(bsdf)});
        });
        sample_look(branch, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          looks.add({frames, sample.weight / choice.chance, sample, true});
        });
      } else {
        scatter(branch, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          scattered.add({frames, sample.weight / choice.chance, sample, false});
        });
      }
    });
    // Frames whose scattering functions are multiples of one another share a hit point.
    for_each_joint(ends, settings_.share_paths, [&](const End& first, std::span<const FrameFactor> factors) {
      add_hit_point(out_.hit_points, path, vertex, factors, first.constant ? nullptr : &*first.bsdf,
                    first.choice.lobes);
    });
    for_each_joint(scattered, settings_.share_paths, [&](const Scattered& first, std::span<const FrameFactor> factors) {
      extend(path, vertex, first.sample, factors);
    });
    for_each_joint(looks, settings_.share_paths, [&](const Scattered& first, std::span<const FrameFactor> factors) {
      look(path, vertex, first.sample, factors);
    });
  }

  /// Calls fn(f if it is constant) unless nothing can be gathered.
  template <class Fn>
  void end(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice, Fn&& fn) {
    if (settings_.sample_direct)
      add_direct_light(path, vertex, bsdf, choice, choice.lobes, [&](const LightSample& sample) {
        if (settings_.direct == nullptr) return 1.f;
        return settings_.direct->weight_of_sample(sample, {vertex.point.p, vertex.point.ng});
      });
    std::optional<Rgb> constant;
    if (!settings_.keep_bsdf) constant = bsdf.lambertian(choice.lobes);
    if (!constant || !is_black(*constant)) fn(constant);
  }

  /// `bsdf`: null if f is constant and among the factors.
  void add_hit_point(std::vector<HitPoint>& hit_points, const CameraPath& path, const Vertex& vertex,
                     std::span<const FrameFactor> factors, const Bsdf* bsdf, LobeSet lobes) {
    CameraPath ended = path;
    const auto keep = [&](StrandList, FrameSet frames, const Rgb&, const Rgb& after) {
      return if_finite(after, path, vertex, frames);
    };
    if (!multiply(ended, factors, out_.strands, ByRatio::yes, keep)) return;
    const SurfacePoint& point = vertex.point;
    HitPoint& hit = hit_points.emplace_back();
    hit.p = point.p;
    hit.ng = dot(vertex.wo, point.ng) < 0 ? -point.ng : point.ng;
    hit.throughput = ended.throughput, hit.strands = ended.strands;
    hit.frames = ended.frames, hit.pixel = path.pixel;
    hit.radius = radius(path);
    if (&hit_points == &out_.hit_points)
      out_.radii_in_pixels += static_cast<double>(hit.radius / path.camera->pixel_spacing(path.length));
    out_.paths.weighted += ended.strands != 0;
    if (bsdf == nullptr) return;
    hit.scattering = static_cast<int>(out_.scatterings.size());
    out_.scatterings.push_back({BsdfSlot::copy_of(*bsdf), vertex.wo, point.p_error, lobes, bsdf->transmits(lobes),
                                vertex.material_element().index});
  }

  /// Calls fn(const BsdfSample&) unless the frames end.
  template <class Fn>
  void scatter(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice, Fn&& fn) {
    // A glossy lobe finds lights by a shadow ray and by the scattered ray, which never hits a point, spot or distant
    // light: what those send through specular lobes is left to the photons stored for this purpose.
    if (const LobeSet glossy = choice.lobes & glossy_lobes(bsdf, settings_.least_alpha)) {
      add_direct_light(path, vertex, bsdf, choice, choice.lobes, [&](const LightSample& sample) {
        if (!(sample.pdf_w > 0)) return 1.f;
        return balance(sample.pdf_w, bsdf.pdf_w(vertex.wo, sample.lit.wi, Transport::radiance, choice.lobes));
      });
      const FrameFactor f{path.frames, Rgb(1 / choice.chance)};
      if (has_hidden_) add_hit_point(out_.glossy, path, vertex, {&f, 1}, &bsdf, glossy);
    }
    const auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::radiance, choice.lobes);
    if (!sample) return;
    if (!is_finite(sample->wi)) return reject(path, path.frames, vertex.material_element());
    fn(*sample);
  }

  /// Calls fn(const BsdfSample&) if a ray that is scattered at the hit point may look for lights.
  template <class Fn>
  void sample_look(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice, Fn&& fn) {
    if (settings_.direct == nullptr || !settings_.direct->scatters()) return;
    const auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::radiance, choice.lobes);
    if (!sample) return;
    if (!is_finite(sample->wi)) return reject(path, path.frames, vertex.material_element());
    fn(*sample);
  }

  void look(const CameraPath& path, const Vertex& vertex, const BsdfSample& sample,
            std::span<const FrameFactor> factors) {
    CameraPath& branch = branches_.push(path);
    extend_ray(branch, vertex.point, sample);
    branch.from = vertex.point.p, branch.from_ng = vertex.point.ng, branch.only_looks = true;
    const auto keep = [&](StrandList, FrameSet frames, const Rgb&, const Rgb& after) {
      return if_finite(after, path, vertex, frames);
    };
    if (!multiply(branch, factors, out_.strands, ByRatio::yes, keep)) branches_.drop();
  }

  float weight_of_look(const CameraPath& path, const SceneLight& scene_light, const Light& light,
                       const LightStart& start) const {
    return settings_.direct->weight_of_scattered(scene_light, light, start, {path.from, path.from_ng});
  }

  void extend(const CameraPath& path, const Vertex& vertex, const BsdfSample& sample,
              std::span<const FrameFactor> factors) {
    CameraPath& branch = branches_.push(path);
    extend_ray(branch, vertex.point, sample);
    branch.from = vertex.point.p, branch.pdf_w = sample.specular ? 0 : sample.pdf_w;
    const float u = path.random.number(path.bounces, kRoulette);
    const auto roulette = [&](StrandList, FrameSet frames, const Rgb&, const Rgb& product) {
      const Rgb after = if_finite(product, path, vertex, frames);
      const float p = roulette_chance(after, branch.eta_scale, path.bounces);
      return p >= 1 ? after : u < p ? after * (1 / p) : Rgb();
    };
    const ByRatio by_ratio = path.bounces < kFirstRouletteBounce ? ByRatio::yes : ByRatio::no;
    if (!multiply(branch, factors, out_.strands, by_ratio, roulette)) branches_.drop();
  }

  template <class Weight>
  void add_direct_light(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice,
                        LobeSet lobes, Weight&& weight) {
    sample_direct_light(scene_, path, vertex, path.frames, bsdf, lobes, out_.paths, weight,
                        [&](FrameSet frames, const Rgb& radiance, auto&& giver) {
                          see(path, frames, radiance / choice.chance, giver);
                        });
  }

  /// `giver`: its source, blamed if it is not finite.
  template <class WhoGave>
  void see(const CameraPath& path, FrameSet frames, const Rgb& radiance, WhoGave&& giver) {
    for_each_strand(out_.strands.of(path.strands), frames, [&](FrameSet alike, const Rgb& weight) {
      const Rgb seen = path.throughput * weight * radiance;
      if (!is_finite(seen)) return reject(path, alike, giver());
      out_.seen.push_back({path.pixel, alike, seen});
    });
  }
  void reject(const CameraPath& path, FrameSet frames, const SceneElement& giver) {
    out_.rejections.add(giver, frames, path.pixel);
  }
  Rgb if_finite(const Rgb& carried, const CameraPath& path, const Vertex& vertex, FrameSet frames) {
    if (is_finite(carried)) return carried;
    reject(path, frames, vertex.material_element());
    return {};
  }

  float radius(const CameraPath& path) const {
    if (settings_.radius > 0) return settings_.radius;
    return std::clamp(kRadiusInPixels * path.camera->pixel_spacing(path.length), 1e-6f * scene_.radius,
                      kLargestShareOfScene * scene_.radius);
  }

  const Scene& scene_;
  const RenderSettings& render_;
  const HitPointSettings& settings_;
  bool has_hidden_;  // hidden photons may exist
  HitPointTile& out_;
  BranchingPath<CameraPath> branches_;
  PartedPaths parted_;
  bool finishing_ = false;
};

void clear(HitPointTile& tile) {
  tile.hit_points.clear();
  tile.glossy.clear();
  tile.scatterings.clear();
  tile.strands.clear();
  tile.seen.clear();
  tile.radii_in_pixels = 0;
  tile.paths = {}, tile.rejections = {};
}

}  // namespace

std::size_t hit_point_tile_count(const PixelRect& crop) {
  return static_cast<std::size_t>(tile_count(crop, kTileSide));
}

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
                                           std::vector<HitPointTile> reuse, int stride) {
  reuse.resize(hit_point_tile_count(render.crop));
  parallel_for(static_cast<std::int64_t>(reuse.size()), 1, [&](std::int64_t t) {
    HitPointTile& tile = reuse[static_cast<std::size_t>(t)];
    clear(tile);
    HitPointTracer tracer(scene, render, settings, tile);
    for_each_pixel_of_tile(render.crop, kTileSide, static_cast<int>(t), [&](int x, int y) {
      if (x % stride == 0 && y % stride == 0) tracer.trace(x, y, iteration);
    });
    tracer.finish();
  });
  return reuse;
}

}  // namespace dspm
