// One step of a path, for camera and photon paths of every integrator: its state, the vertex it reaches, how it is
// extended, and how it ends.
#pragma once

#include <cmath>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/medium_vertex.h"
#include "dspm/integrators/transport/overlap.h"
#include "dspm/integrators/transport/sample_bsdf.h"
#include "dspm/integrators/transport/shading_correction.h"
#include "dspm/integrators/transport/strand.h"
#include "dspm/integrators/transport/walk.h"
#include "dspm/materials/relief.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// A path is a value. When frames part, each group gets a copy, with disjoint frame sets.
struct PathState {
  Ray ray;                 // the next segment
  Spectrum throughput;     // radiance per radiance (camera), or flux in W (photon); includes 1/pdf of all samples
  FrameSet frames;         // the frames in which exactly this path exists; never grows
  int bounces = 0;         // scatterings so far
  float eta_scale = 1;     // what throughput has of the camera's weight and of refractions, which it regains on leaving
  StrandList strands = 0;  // factors to the throughput by frame, if they differ
  PathRandom random = {};  // shared by all branches of the path
  Walk walk = {};          // through the body that the path is in, if that scatters
  Inside inside = {};      // the bodies that the next segment lies in, see nesting.h
  float passed = 0;        // what it has passed of the next segment, through surfaces that are not there
  Flights flights = {};    // through media
  Wavelength wavelength = {};

  /// The diameter, in the world, of what the path stands for at the end of its next segment: textures average over it.
  float diameter(float /*segment*/) const { return 0; }
};

inline bool is_finite(const Ray& ray) { return is_finite(ray.origin) && is_finite(ray.direction); }

/// A path's intersection with a surface, in the frames that meet the same one.
struct Vertex {
  Vertex(const Scene& scene, const Ray& ray, const FrameHit& part, float width = 0)
      : hit(part.hit),
        point(scene.surface_point(part.hit, ray.direction)),
        wo(-ray.direction),
        frames(part.frames),
        diameter(width),
        shape(scene.shapes[static_cast<std::size_t>(part.hit.shape)]),
        material(scene.materials[static_cast<std::size_t>(shape.material)]),
        body(scene.body_of(shape.material)),
        interface(scene.interface_at(part.hit.shape)) {
    point.palette = scene.palette.get();
  }

  RayHit hit;
  SurfacePoint point;
  Vec3 wo;  // back along the path, unit length
  FrameSet frames;
  float diameter;  // of what the path stands for here
  const PlacedShape& shape;
  const FrameStates<Material>& material;
  int body;  // the material of the body that the surface bounds in some frame, if paths need to know it
  const MediumInterface* interface;  // null: the surface parts no media

  /// Returns whether w leads into the body.
  bool leads_inside(const Vec3& w) const { return dspm::leads_inside(body, point.ng, w); }
  /// Returns what a segment in direction w lies in, if the one that arrived here lay in `arriving`.
  Inside inside_beyond(const Inside& arriving, const Vec3& w) const {
    Inside beyond = dspm::inside_beyond(arriving, body, point.ng, wo, w);
    if (interface != nullptr) beyond.medium = interface->medium_towards(dot(w, point.ng) > 0);
    return beyond;
  }
  /// Returns whether textures may average over what the path stands for. They may not if something else varies with
  /// them: the material of a mix, or holes.
  bool averages(const Material& state) const { return diameter > 0 && shape.cutout == nullptr && state.averages(); }
  SurfacePoint covered_point() const {
    SurfacePoint covered = point;
    covered.cover(wo, diameter);
    return covered;
  }
  /// Returns whether the material differs between the frames.
  bool differs() const { return material.differs_in(frames); }

  // The surface as a place that is lit.
  const Vec3& p() const { return point.p; }
  LightReceiver receiver() const { return {point.p, point.turns ? Vec3{} : point.ng}; }
  float cosine(const Vec3& w) const { return std::abs(dot(w, point.ns)); }
  Ray spawn(const Vec3& w) const { return point.spawn(w); }
  SceneElement scatterer() const { return material_element(); }

  // The plugin to blame for values that are not finite.
  SceneElement shape_element() const { return {SceneElement::Kind::shape, hit.shape}; }
  SceneElement material_element() const { return {SceneElement::Kind::material, shape.material}; }
  SceneElement emitter_element() const { return {SceneElement::Kind::light, shape.light}; }
};

/// Calls fn(FrameSet, const Material&, bool averages) for each material that the point is made of in some of the
/// vertex's frames. Mixes that differ may agree about a point.
template <class Fn>
void for_each_material(const Vertex& vertex, Fn&& fn) {
  struct Made {
    FrameSet frames;
    const Material* of;
    bool averages;
  };
  FrameArray<Made> all;
  vertex.material.for_each(vertex.frames, [&](FrameSet frames, const Material& state) {
    const Material& material = state.at(vertex.point);
    const bool averages = vertex.averages(state);
    if (&material != &state)
      for (Made& made : all)
        if (made.of == &material && made.averages == averages) return static_cast<void>(made.frames |= frames);
    all.add({frames, &material, averages});
  });
  for (const Made& made : all) fn(made.frames, *made.of, made.averages);
}

/// Calls fn(FrameSet, const Bsdf&) for each distinct scattering function among the vertex's frames: one, unless the
/// material differs between them.
template <class Fn>
void for_each_surface(const Vertex& vertex, Fn&& fn) {
  for_each_material(vertex, [&](FrameSet frames, const Material& material, bool averages) {
    BsdfSlot slot;
    fn(frames, averages ? material.bsdf(vertex.covered_point(), slot) : material.bsdf(vertex.point, slot));
  });
}

/// One of a vertex's scattering functions, to be kept.
struct Surface {
  FrameSet frames;
  BsdfSlot bsdf;
};

/// Calls fn(const Vertex&) with the normals that the materials' reliefs give: once, unless they differ between the
/// frames. `vertex` has the normals of the shape. Curves have no relief: their normals are those of the ray.
template <class Fn>
void for_each_relief(const Vertex& vertex, Fn&& fn) {
  struct Bent {
    FrameSet frames;
    Vec3 ns;
  };
  FrameArray<Bent> all;
  for_each_material(vertex, [&](FrameSet frames, const Material& material, bool) {
    const Relief* relief = material.relief();
    const Vec3 ns = relief == nullptr || vertex.point.turns
                        ? vertex.point.ns
                        : relief->bent(vertex.point, vertex.shape, vertex.hit.primitive, vertex.hit.uv).ns;
    for (Bent& bent : all)
      if (bent.ns == ns) return static_cast<void>(bent.frames |= frames);
    all.add({frames, ns});
  });
  if (all.size() == 1 && all[0].ns == vertex.point.ns) return static_cast<void>(fn(vertex));
  for (const Bent& bent : all) {
    Vertex shown = vertex;
    shown.frames = bent.frames, shown.point.ns = bent.ns, shown.point.smooth_ns = vertex.point.ns;
    fn(static_cast<const Vertex&>(shown));
  }
}

/// The shading normal without the material's relief.
inline const Vec3& unbent_normal(const SurfacePoint& point) {
  return length2(point.smooth_ns) > 0 ? point.smooth_ns : point.ns;
}

/// Returns the light's index, or -1 if the element is no light.
inline int light_of(const SceneElement& giver) { return giver.kind == SceneElement::Kind::light ? giver.index : -1; }
inline SceneElement light_element(const Scene& scene, const SceneLight& light) {
  return {SceneElement::Kind::light, static_cast<int>(&light - scene.lights.data())};
}

/// Calls fn(FrameSet, const Spectrum&, const Light&) with the surface's emission back along the path, once per group of
/// frames that agree.
template <class Fn>
void for_each_emission(const Scene& scene, const Vertex& vertex, FrameSet frames, Fn&& fn) {
  if (vertex.shape.light < 0) return;
  const SceneLight& light = scene.lights[static_cast<std::size_t>(vertex.shape.light)];
  light.states.for_each(frames, [&](FrameSet lit, const Light& state) {
    const Spectrum radiance = state.carried(state.emitted(vertex.point, vertex.wo), *scene.palette);
    if (!is_black(radiance)) fn(lit, radiance, state);
  });
}

/// Calls fn(FrameSet, const Spectrum&, const SceneLight&, const Light&) with the light from infinity for a path that left
/// the scene. After no bounces it is what the camera sees as the background.
template <class Fn>
void for_each_escape(const Scene& scene, FrameSet frames, const Ray& ray, int bounces, Fn&& fn) {
  for (const int index : scene.infinite_lights) {
    const SceneLight& scene_light = scene.lights[static_cast<std::size_t>(index)];
    scene_light.states.for_each(frames, [&](FrameSet common, const Light& light) {
      const Spectrum radiance = bounces == 0 ? light.carried_background(ray, *scene.palette)
                                             : light.carried(light.escaped(ray), *scene.palette);
      if (!is_black(radiance)) fn(common, radiance, scene_light, light);
    });
  }
}

inline std::optional<BsdfSample> sample_bsdf(const Bsdf& bsdf, const PathState& path, const Vec3& wo,
                                             Transport transport, LobeSet lobes) {
  return sample_bsdf(bsdf, wo, transport, lobes, path.random, path.bounces);
}

/// Starts the path's next segment along the sampled direction; the caller updates the throughput.
inline void extend_ray(PathState& path, const SurfacePoint& point, const BsdfSample& sample) {
  path.eta_scale *= sample.eta_scale;
  path.wavelength.alone |= sample.by_wavelength;
  path.ray = point.spawn(sample.wi), path.passed = 0, path.flights.numbers = 0;
  ++path.bounces;
  if (sample.ahead) path.walk = Walk(*sample.ahead);
  path.walk.start(path.ray, path.random, path.bounces);
}
inline void extend_ray(PathState& path, const MediumVertex& vertex, const Vec3& w) {
  path.ray = vertex.spawn(w), path.passed = 0, path.flights.numbers = 0;
  ++path.bounces;
}
inline void extend_ray(PathState& path, const Vertex& vertex, const BsdfSample& sample) {
  if (vertex.body != kNoBody || vertex.interface != nullptr) path.inside = vertex.inside_beyond(path.inside, sample.wi);
  extend_ray(path, vertex.point, sample);
}
inline void extend(PathState& path, const Vertex& vertex, const BsdfSample& sample) {
  path.throughput *= sample.weight;
  extend_ray(path, vertex, sample);
}

}  // namespace dspm
