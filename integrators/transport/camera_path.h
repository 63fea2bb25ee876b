// Camera paths, starting at the film.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/camera_numbers.h"
#include "dspm/integrators/tiles.h"
#include "dspm/integrators/transport/medium_vertex.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/shapes/curvature.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct CameraPath : PathState {
  const Camera* camera = nullptr;
  int pixel = 0;     // within the crop
  float length = 0;  // of the segments so far, in world units
  float width = 0;   // in pixel spacings: of what it stands for
  // What curved mirrors and lenses have added to the spacing where the next segment starts, and add to it per length.
  float more_spacing = 0, more_spread = 0;
  Vec3 from = {};  // where the next segment starts: the last surface's point
  // Of its direction, by solid angle; 0 from the camera and off specular lobes: no shadow ray competes.
  float pdf_w = 0;
  Vec3 from_ng = {};      // the normal there; zero on a surface that turns to rays
  bool indirect = false;  // it has left a hit point: lights that it meets count only while it looks for them
  bool looks = false;     // along its next segment
  bool caught = false;    // its first surface is a shadow catcher
  bool of_media = false;  // a medium before the first surface has scattered it

  /// Call this at each vertex.
  void arrive(const Scene& scene, const Vertex& vertex) {
    if (bounces == 0) caught = scene.is_catcher(vertex.hit.shape);
  }
  /// Call this at each collision with a medium.
  void collide() { of_media |= bounces == 0; }
  /// The surface that it has left, as a receiver of light that it meets.
  LightReceiver departure() const { return {from, from_ng}; }
  /// Call this when the path has passed through its segment.
  void travel(float segment) { length += segment, more_spacing += more_spread * segment; }
  /// Call this when the path goes on along that sample.
  void leave(const Vertex& vertex, const BsdfSample& sample) {
    from = vertex.point.p, from_ng = vertex.point.turns ? Vec3{} : vertex.point.ng,
    pdf_w = sample.specular ? 0 : sample.pdf_w;
    if (sample.specular && width > 0 && !vertex.point.turns) spread(vertex, sample);
  }
  /// The same from a collision with a medium, in direction w.
  void leave(const MediumVertex& vertex, const Vec3& w, float density) {
    from = vertex.point, from_ng = {}, pdf_w = density;
    extend_ray(*this, vertex, w);
  }
  float diameter(float segment) const {
    return width * std::abs(camera->pixel_spacing(length + segment) + more_spacing + more_spread * segment);
  }

 private:
  /// Updates how fast neighbouring rays part: in the plane across that of the two directions, which a disk stands for
  /// here, n_i spread_i - n_o spread_o = (n_o cos_o + n_i cos_i) curvature spacing, with signed cosines. [Coddington;
  /// as Igehy 1999, Tracing Ray Differentials, (15) and (17), for that plane]
  void spread(const Vertex& vertex, const BsdfSample& sample) {
    const float eta = 1 / std::sqrt(sample.eta_scale), n_dot_o = dot(vertex.point.ns, vertex.wo);
    const float power = n_dot_o + eta * dot(vertex.point.ns, sample.wi);
    if (eta == 1 && power == 0) return;
    const float own = camera->pixel_spacing(1) - camera->pixel_spacing(0);
    const float bent = power * mean_curvature(vertex.shape, vertex.hit.primitive, vertex.hit.uv) *
                       (camera->pixel_spacing(length) + more_spacing);
    more_spread = (own + more_spread + bent) / eta - own;
  }
};

/// Sends the path on along the sample; the caller updates the throughput.
inline void leave(CameraPath& path, const Vertex& vertex, const BsdfSample& sample) {
  extend_ray(path, vertex, sample);
  path.leave(vertex, sample);
}
inline void leave(CameraPath& path, const MediumVertex& vertex, const BsdfSample& sample) {
  path.leave(vertex, sample.wi, sample.pdf_w);
}

/// Returns the width of a path in pixels. As in pbrt, each of n paths through a pixel stands for 1 / sqrt(n) of its
/// width, but for at least an eighth. As nobody knows n before the end, it is the number of paths so far: the first
/// image is smooth, and the last one sharp.
inline float path_width(const RenderSettings& render, std::uint64_t iteration) {
  return render.filter_textures ? std::max(0.125f, 1 / std::sqrt(static_cast<float>(iteration) + 1)) : 0;
}

/// The seed of a camera's paths. States of the camera have paths of their own, so they lose no sharing if they draw other
/// numbers. What a state sees tells it from the others, whichever frames are rendered.
inline std::uint64_t camera_seed(const RenderSettings& render, const Camera& camera) {
  std::uint64_t seed = render.seed;
  if (!render.noise_per_frame) return seed;
  const auto width = static_cast<float>(render.width), height = static_cast<float>(render.height);
  for (const Vec2 film : {Vec2{width / 2, height / 2}, Vec2{width, height}}) {
    const Ray ray = camera.ray(film, {0.5f, 0.5f});
    for (const Vec3& v : {ray.origin, ray.direction})
      for (const float number : {v.x, v.y, v.z}) seed = mix_bits(seed ^ std::bit_cast<std::uint32_t>(number));
  }
  return seed;
}

/// Calls start(const CameraPath&) for each state of the camera in these frames, at pixel x, y of the full image, or
/// lost(const CameraPath&) if the camera's ray is not finite. No path starts where its lens lets nothing through.
template <class Start, class Lost>
void start_camera_paths(const Scene& scene, const RenderSettings& render, int x, int y, std::uint64_t iteration,
                        FrameSet among, Start&& start, Lost&& lost) {
  CameraPath path;
  path.pixel = pixel_in_crop(render.crop, x, y), path.width = path_width(render, iteration);
  path.wavelength = {.nm = scene.nm_of(render.seed, iteration), .weighs = true};
  scene.camera.for_each(among & scene.frames(), [&](FrameSet frames, const Camera& camera) {
    path.random = camera_numbers(render, camera_seed(render, camera), x, y, iteration);
    const Vec2 film = film_point(render, x, y, path.random), lens = path.random.pair(0, kLightDirection);
    const float weight = camera.weight(film, lens);
    if (!(weight > 0)) return;
    path.throughput = Spectrum(weight), path.eta_scale = weight;
    path.ray = camera.ray(film, lens), path.camera = &camera;
    const auto begin = [&](FrameSet in, const Inside& inside) {
      path.frames = in, path.inside = inside;
      if (is_finite(path.ray))
        start(path);
      else
        lost(path);
    };
    if (scene.around_camera.empty()) return begin(frames, {});
    for (const auto& around : scene.around_camera)
      if (const FrameSet common = frames & around.frames; !common.empty()) begin(common, around.inside);
  });
}

/// The same in all frames.
template <class Start, class Lost>
void start_camera_paths(const Scene& scene, const RenderSettings& render, int x, int y, std::uint64_t iteration,
                        Start&& start, Lost&& lost) {
  start_camera_paths(scene, render, x, y, iteration, scene.frames(), start, lost);
}

}  // namespace dspm
