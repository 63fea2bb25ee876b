#include "dspm/integrators/photons/trace_hit_points.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/hit_point_light.h"
#include "dspm/integrators/photons/hit_point_writer.h"
#include "dspm/integrators/tiles.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/lobe_choice.h"
#include "dspm/integrators/transport/parted_paths.h"
#include "dspm/integrators/transport/roulette_chance.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr int kTileSide = 16;
constexpr int kPilotsAcross = 8;  // of a tile of few pixels: they are short work, for many threads

/// Learning looks at every pixel of a small picture, tile by tile: there, large tiles keep neighbours together.
int tile_side(const PixelRect& crop, int stride = 1) {
  constexpr int kSmall = 1 << 13;
  if (stride > 1) return kPilotsAcross * stride;
  return crop.count() < kSmall ? 2 * kTileSide : kTileSide;
}

/// The way in which a path ends in a hit point in some of its frames.
struct End {
  FrameSet frames;
  LobeChoice choice;
  bool constant;  // whether f is, and so stored here; else the bsdf gives it
  Spectrum f;
  const Bsdf* bsdf;

  std::optional<Spectrum> along(const End& first) const {
    if (constant != first.constant || choice.lobes != first.choice.lobes) return std::nullopt;
    if (constant) return f / choice.chance;
    const auto ratio = this == &first ? Spectrum(1) : bsdf->ratio_to(*first.bsdf, choice.lobes);
    // Even if f is black, hj09 counts the photons.
    if (!ratio || !(std::min({(*ratio)[0], (*ratio)[1], (*ratio)[2]}) > 0)) return std::nullopt;
    return *ratio / choice.chance;
  }
};

class HitPointTracer {
 public:
  HitPointTracer(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings, HitPointTile& out)
      : scene_(scene),
        render_(render),
        settings_(settings),
        has_hidden_(may_hide_photons(scene, settings)),
        tile_(out),
        out_(scene, settings, out),
        light_(scene, render, settings, out_),
        branches_(scene, out.paths) {}

  /// Traces the camera path of pixel x, y of the full image. Paths whose frames part wait for finish().
  void trace(int x, int y, std::uint64_t iteration) {
    start_camera_paths(
        scene_, render_, x, y, iteration, settings_.frames,
        [&](const CameraPath& path) {
          branches_.push(path);
          branches_.follow(*this);
        },
        [&](const CameraPath& path) { out_.reject(path, path.frames, {SceneElement::Kind::camera}); });
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
  friend MediumSegment<BranchingPath<CameraPath>>;

  StrandTable& strands() { return tile_.strands; }

  bool postpones(const CameraPath& path, const HitPartition& parts) {
    if (parts.size() == 1 || finishing_) return false;
    parted_.add(path, parts);
    return true;
  }

  void escaped(const CameraPath& path, FrameSet frames) { light_.meet_infinity(path, frames); }

  void lost(const CameraPath& path, FrameSet frames, const SceneElement& giver) { out_.reject(path, frames, giver); }

  /// A path that has left a hit point looks for lights alone.
  void beamed(const CameraPath& passing, const MediumSection& section) {
    if (passing.indirect) return;
    CameraPath path = passing;
    path.collide();
    out_.add_beam(path, section), light_.add(path, section);
  }

  void arrived(const CameraPath& path, const Vertex& vertex) {
    CameraPath arriving = path;
    arriving.arrive(scene_, vertex);
    light_.meet_surface(arriving, vertex);
    if ((path.indirect && !settings_.go_on) || path.bounces >= settings_.max_depth) return;
    arriving.travel(vertex.hit.t), arriving.frames = vertex.frames, arriving.looks = false;
    if (vertex.differs()) return scatter_together(arriving, vertex);
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      arriving.frames = frames;
      const LobeChoice choice = choose_lobes(bsdf, path, vertex, settings_.least_alpha);
      const HitPointLight::Surface surface{frames, &bsdf, choice};
      light_.add(arriving, vertex, {&surface, 1});
      if (choice.rough) {
        end(vertex, bsdf, choice, [&](const std::optional<Spectrum>& constant) {
          const FrameFactor f{frames, constant.value_or(Spectrum(1)) / choice.chance};
          out_.add_hit_point(tile_.hit_points, arriving, vertex, {&f, 1}, constant ? nullptr : &bsdf, choice.lobes);
        });
        sample_further(arriving, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          const FrameFactor f{frames, sample.weight / choice.chance};
          leave(arriving, vertex, sample, {&f, 1});
        });
      } else {
        scatter(arriving, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          const FrameFactor f{frames, sample.weight / choice.chance};
          extend(arriving, vertex, sample, {&f, 1});
        });
      }
    });
  }

  /// Scatters at a material that differs between the frames.
  [[gnu::noinline]] void scatter_together(const CameraPath& path, const Vertex& vertex) {
    FrameArray<BsdfSlot> slots;
    FrameArray<HitPointLight::Surface> surfaces;
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      surfaces.add(
          {frames, &*slots.add(BsdfSlot::copy_of(bsdf)), choose_lobes(bsdf, path, vertex, settings_.least_alpha)});
    });
    light_.add(path, vertex, std::span<const HitPointLight::Surface>(surfaces));
    FrameArray<End> ends;
    FrameArray<Scattered> scattered, leaving;
    for (const HitPointLight::Surface& surface : surfaces) {
      const FrameSet frames = surface.frames;
      const LobeChoice& choice = surface.choice;
      const Bsdf& bsdf = *surface.bsdf;
      CameraPath branch = path;
      branch.frames = frames;
      if (choice.rough) {
        end(vertex, bsdf, choice, [&](const std::optional<Spectrum>& constant) {
          ends.add({frames, choice, constant.has_value(), constant.value_or(Spectrum()), &bsdf});
        });
        sample_further(branch, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          leaving.add({frames, sample.weight / choice.chance, sample, true});
        });
      } else {
        scatter(branch, vertex, bsdf, choice, [&](const BsdfSample& sample) {
          scattered.add({frames, sample.weight / choice.chance, sample, false});
        });
      }
    }
    // Frames whose scattering functions are multiples of one another share a hit point.
    for_each_joint(ends, settings_.share_paths, [&](const End& first, std::span<const FrameFactor> factors) {
      out_.add_hit_point(tile_.hit_points, path, vertex, factors, first.constant ? nullptr : first.bsdf,
                         first.choice.lobes);
    });
    for_each_joint(scattered, settings_.share_paths, [&](const Scattered& first, std::span<const FrameFactor> factors) {
      extend(path, vertex, first.sample, factors);
    });
    for_each_joint(leaving, settings_.share_paths, [&](const Scattered& first, std::span<const FrameFactor> factors) {
      leave(path, vertex, first.sample, factors);
    });
  }

  /// Calls fn(f if it is constant, as is the cosine that photons count by, and only one side gets light) unless nothing
  /// can be gathered.
  template <class Fn>
  void end(const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice, Fn&& fn) {
    std::optional<Spectrum> constant;
    const bool is_bent = !(vertex.point.ns == unbent_normal(vertex.point));
    if (!settings_.keep_bsdf && !is_bent) constant = constant_on_one_side(bsdf, choice.lobes);
    if (!constant || !is_black(*constant)) fn(constant);
  }

  /// Calls fn(const BsdfSample&) unless the frames end.
  template <class Fn>
  void scatter(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice, Fn&& fn) {
    // What point, spot and distant lights send through specular lobes is left to the photons stored for this purpose.
    const LobeSet glossy = choice.lobes & glossy_lobes(bsdf, vertex.point, settings_.least_alpha);
    const FrameFactor f{path.frames, Spectrum(1 / choice.chance)};
    if (glossy != 0 && !path.indirect && has_hidden_)
      out_.add_hit_point(tile_.glossy, path, vertex, {&f, 1}, &bsdf, glossy);
    auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::radiance, choice.lobes);
    if (!sample) return;
    if (!is_finite(sample->wi)) return out_.reject(path, path.frames, vertex.material_element());
    if (settings_.sample_direct) sample->pdf_w *= choice.chance;  // shadow rays have not waited for this choice
    fn(*sample);
  }

  /// Calls fn(const BsdfSample&) if a ray that is scattered at the hit point looks for lights, or goes on.
  template <class Fn>
  void sample_further(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf, const LobeChoice& choice,
                      Fn&& fn) {
    if (!settings_.go_on && !light_.scatters()) return;
    const auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::radiance, choice.lobes);
    const bool in_vain = !settings_.go_on && sample && bsdf.enters(sample->wi);  // no light is seen inside a body
    if (!sample || in_vain) return;
    if (!is_finite(sample->wi)) return out_.reject(path, path.frames, vertex.material_element());
    fn(*sample);
  }

  /// Leaves a hit point.
  void leave(const CameraPath& path, const Vertex& vertex, const BsdfSample& sample,
             std::span<const FrameFactor> factors) {
    CameraPath& branch = branches_.push(path);
    extend_ray(branch, vertex, sample);
    branch.from = vertex.point.p, branch.from_ng = vertex.point.ng;
    branch.indirect = true, branch.looks = light_.scatters();
    if (!(settings_.go_on ? survives(branch, path, vertex, factors) : out_.carry(branch, vertex, factors)))
      branches_.drop();
  }

  void extend(const CameraPath& path, const Vertex& vertex, const BsdfSample& sample,
              std::span<const FrameFactor> factors) {
    CameraPath& branch = branches_.push(path);
    extend_ray(branch, vertex, sample);
    branch.leave(vertex, sample);
    if (!survives(branch, path, vertex, factors)) branches_.drop();
  }

  /// Multiplies what the branch carries by the factors, and plays roulette. Returns whether it goes on in any frame.
  bool survives(CameraPath& branch, const CameraPath& path, const Vertex& vertex,
                std::span<const FrameFactor> factors) {
    const float u = path.random.number(path.bounces, kRoulette);
    const auto roulette = [&](const Spectrum& after) {
      return left_by_roulette(after, roulette_chance(after, branch.eta_scale, path.bounces), u);
    };
    const ByRatio by_ratio = path.bounces < kFirstRouletteBounce ? ByRatio::yes : ByRatio::no;
    return out_.carry(branch, vertex, factors, by_ratio, roulette);
  }

  const Scene& scene_;
  const RenderSettings& render_;
  const HitPointSettings& settings_;
  bool has_hidden_;
  HitPointTile& tile_;
  HitPointWriter out_;
  HitPointLight light_;
  BranchingPath<CameraPath> branches_;
  PartedPaths parted_;
  bool finishing_ = false;
};

}  // namespace

std::size_t hit_point_tile_count(const PixelRect& crop) {
  return static_cast<std::size_t>(tile_count(crop, tile_side(crop)));
}

bool may_hide_photons(const Scene& scene, const HitPointSettings& settings) {
  return settings.least_alpha < kNothingGathers && std::ranges::any_of(scene.lights, &SceneLight::is_delta);
}

std::vector<std::array<int, 2>> pixels_of_hit_point_tile(const RenderSettings& render, const HitPointSettings& settings,
                                                         std::size_t tile, int stride) {
  std::vector<std::array<int, 2>> pixels;
  for_each_pixel_of_tile(render.crop, tile_side(render.crop, stride), static_cast<int>(tile), [&](int x, int y) {
    if (x % stride == 0 && y % stride == 0 && settings.pixels.contain(x, y)) pixels.push_back({x, y});
  });
  return pixels;
}

std::vector<HitPointTile> trace_hit_points(const Scene& scene, const RenderSettings& render,
                                           const HitPointSettings& settings, std::uint64_t iteration,
                                           std::vector<HitPointTile> reuse, int stride) {
  reuse.resize(static_cast<std::size_t>(tile_count(render.crop, tile_side(render.crop, stride))));
  parallel_for(static_cast<std::int64_t>(reuse.size()), 1, [&](std::int64_t number) {
    const auto t = static_cast<std::size_t>(number);
    reuse[t].start(*scene.palette);
    HitPointTracer tracer(scene, render, settings, reuse[t]);
    for (const auto& [x, y] : pixels_of_hit_point_tile(render, settings, t, stride)) tracer.trace(x, y, iteration);
    tracer.finish();
  });
  return reuse;
}

}  // namespace dspm
