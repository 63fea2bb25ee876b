// Writes what camera paths leave in a tile: light that they see, and hit points. Values that are negative or not finite
// are rejected and blamed on whoever gave them.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class HitPointWriter {
 public:
  HitPointWriter(const Scene& scene, const HitPointSettings& settings, HitPointTile& tile)
      : scene_(scene), settings_(settings), tile_(tile) {}

  PathCounts& paths() { return tile_.paths; }

  /// Adds light that the path sees. `giver` returns its source: the light if the radiance is finite, else the one to
  /// blame.
  template <class WhoGave>
  void see(const CameraPath& path, FrameSet frames, const Spectrum& radiance, WhoGave&& giver) {
    for_each_strand(tile_.strands.of(path.strands), frames, [&](FrameSet alike, const Spectrum& weight) {
      const Spectrum seen = path.throughput * weight * radiance;
      if (!is_light(seen)) return reject(path, alike, giver());
      tile_.seen.push_back(
          {alike, scene_.palette->seen(seen), path.pixel, light_of(giver()), path.caught, path.of_media});
    });
  }

  void reject(const CameraPath& path, FrameSet frames, const SceneElement& giver) {
    tile_.rejections.add(giver, frames, path.pixel);
  }

  Spectrum if_finite(const Spectrum& carried, const CameraPath& path, const Vertex& vertex, FrameSet frames) {
    if (is_light(carried)) return carried;
    reject(path, frames, vertex.material_element());
    return {};
  }

  /// Multiplies what the path, here at `vertex`, carries; keep(frames, product) returns what is left of it. Returns
  /// whether any frame goes on.
  template <class Keep>
  bool carry(CameraPath& path, const Vertex& vertex, std::span<const FrameFactor> factors, ByRatio by_ratio,
             Keep&& keep) {
    return multiply(path, factors, tile_.strands, by_ratio,
                    [&](StrandList, FrameSet frames, const Spectrum&, const Spectrum& product) {
                      return keep(if_finite(product, path, vertex, frames));
                    });
  }
  bool carry(CameraPath& path, const Vertex& vertex, std::span<const FrameFactor> factors) {
    return carry(path, vertex, factors, ByRatio::yes, [](const Spectrum& product) { return product; });
  }

  /// Adds a hit point. `bsdf` is null if f is constant and among the factors.
  void add_hit_point(std::vector<HitPoint>& hit_points, const CameraPath& path, const Vertex& vertex,
                     std::span<const FrameFactor> factors, const Bsdf* bsdf, LobeSet lobes) {
    CameraPath ended = path;
    if (!carry(ended, vertex, factors)) return;
    const SurfacePoint& point = vertex.point;
    add_hit_point(hit_points, ended, {point, unbent_normal(point), vertex.wo, vertex.hit}, bsdf, lobes);
    if (bsdf == nullptr || !point.turns) return;
    tile_.scatterings.back().strip = static_cast<int>(tile_.strips.size());
    tile_.strips.push_back({StripPlace(vertex.shape, vertex.hit, vertex.wo), point.ns});
  }

  /// A surface where paths end.
  struct EndSurface {
    const SurfaceGeometry& point;
    Vec3 unbent_ns, wo;
    const RayHit& hit;  // the camera path's
  };

  /// Adds a hit point of a path that carries what is left of it there.
  void add_hit_point(std::vector<HitPoint>& hit_points, const CameraPath& ended, const EndSurface& at, const Bsdf* bsdf,
                     LobeSet lobes) {
    HitPoint& hit = hit_points.emplace_back();
    hit.p = at.point.p;
    hit.ng = dot(at.wo, at.point.ng) < 0 ? -at.point.ng : at.point.ng;
    hit.face = ShapeFace(at.hit.shape, at.point.ng, at.wo);
    hit.throughput = ended.throughput, hit.strands = ended.strands;
    hit.frames = ended.frames, hit.pixel = ended.pixel, hit.indirect = ended.indirect, hit.caught = ended.caught;
    hit.wavelength = ended.wavelength;
    hit.radius = radius(ended);
    if (&hit_points == &tile_.hit_points)
      tile_.radii_in_pixels += static_cast<double>(hit.radius / ended.camera->pixel_spacing(ended.length));
    tile_.paths.weighted += ended.strands != 0;
    if (bsdf == nullptr) return;
    hit.scattering = static_cast<int>(tile_.scatterings.size());
    tile_.scatterings.push_back(
        {BsdfSlot::copy_of(*bsdf), at.wo, at.point.p_error, lobes, bsdf->transmits(bsdf->all_lobes()),
         scene_.shapes[static_cast<std::size_t>(at.hit.shape)].material, ended.inside, at.point.ns, at.unbent_ns});
    tile_.scatterings.back().hit = at.hit;
  }

  /// Adds the part of the path's segment that the section is, and what the medium there gives off. Photons bring what it
  /// scatters. Close to the camera the radius is not that of few pixels: single photons there would be specks of light.
  void add_beam(const CameraPath& path, const MediumSection& section) {
    if (max_component(section.glow) > 0)
      see(path, path.frames, section.glow, [&] { return glow_element(scene_, path.inside.medium); });
    if (path.bounces >= settings_.max_depth) return;
    const auto pixels = [&](float length) { return kRadiusInPixels * path.camera->pixel_spacing(length); };
    const float length = path.length + path.passed, near = pixels(length), most = kLargestShareOfScene * scene_.radius;
    CameraBeam& beam = tile_.beams.emplace_back();
    beam.ray = path.ray, beam.begin = section.begin, beam.end = section.end;
    beam.throughput = path.throughput, beam.frames = path.frames, beam.strands = path.strands;
    beam.pixel = path.pixel, beam.caught = path.caught, beam.of_media = path.of_media, beam.medium = path.inside.medium;
    beam.is_alone = path.wavelength.alone;
    beam.radius = settings_.radius, beam.least = beam.most = settings_.radius;
    if (!(settings_.radius > 0)) {
      beam.radius = near, beam.spread = pixels(length + 1) - near;
      beam.least = std::min(most, pixels(scene_.radius)), beam.most = most;
    }
    beam.left = section.left, beam.sigma_t = section.sigma_t;
    beam.first_step = static_cast<std::uint32_t>(tile_.steps.size());
    beam.steps = static_cast<std::uint32_t>(section.steps.size());
    tile_.steps.insert(tile_.steps.end(), section.steps.begin(), section.steps.end());
  }

 private:
  // A few pixel spacings, bounded by a fraction of the scene for points near the horizon.
  static constexpr float kRadiusInPixels = 4, kLargestShareOfScene = 0.05f;

  float radius(const CameraPath& path) const {
    if (settings_.radius > 0) return settings_.radius;
    return std::clamp(kRadiusInPixels * path.camera->pixel_spacing(path.length), 1e-6f * scene_.radius,
                      kLargestShareOfScene * scene_.radius);
  }

  const Scene& scene_;
  const HitPointSettings& settings_;
  HitPointTile& tile_;
};

}  // namespace dspm
