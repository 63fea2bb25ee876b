// What a path of a wave meets next, frame by frame: what branching_path.h does for paths one by one. Surfaces that are not
// there, because a body of higher priority is, end no segment; bodies absorb along the way.
#pragma once

#include "dspm/accel/ray_hit.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/overlap.h"
#include "dspm/integrators/waves/plain_bodies.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/materials/plain_material.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/world/scene/inside.h"

namespace dspm {

/// What the state of every path of a wave has of PathState.
struct BodiesOfPath {
  Inside inside;
  float passed = 0;
};

/// A surface at which a path has arrived.
struct Arrival {
  const PlainPlacedShape& shape;
  FrameHit part;  // with the whole length of the segment
  SurfaceGeometry point;
  const PlainScene& scene;
  const PlainBody* around;  // of higher priority; null: none
  bool differs;             // the part's frames are not all in one state of the material

  /// Calls fn(FrameSet, const PlainMaterial&) for each state of the material, as it is within the bodies around it.
  template <class Fn>
  constexpr void for_each_state(const Fn& fn) const {
    scene.for_each_state(shape.material, around, part.frames, fn);
  }
};

/// Returns the path as it goes straight on through a surface that is not there, `distance` along its ray; its segment lay in
/// `arriving`.
template <class State>
constexpr State passed(const State& path, const SurfaceGeometry& point, int body, const Inside& arriving,
                       float distance) {
  State on = path;
  on.ray = point.spawn(path.ray.direction, path.ray.t_max - distance);
  on.bodies.inside = inside_beyond(arriving, body, point.ng, -path.ray.direction, path.ray.direction);
  on.bodies.passed += distance;
  return on;
}

/// Absorbs what the bodies that the path lies in do along `distance`, perhaps infinite. Returns whether anything is left.
template <class State, class Out>
constexpr bool dim(const PlainBodies& bodies, State& path, float distance, Out& out) {
  if (path.bodies.inside.is_empty()) return true;
  const Spectrum before = path.throughput;
  path.throughput = before * bodies.left_within(path.bodies.inside, distance);
  if constexpr (requires { out.dim(path.frames, before, before); }) out.dim(path.frames, before, path.throughput);
  return !is_black(path.throughput);
}

/// Takes the path to what it meets next. `out` has
///   void segment(const State&, const HitPartition&)   a ray was traced
///   void push(const State&)                           the path goes on, in the next wave
///   void part(const State&)                           its frames differ in the material there
///   void dim(FrameSet, before, after)                 optional: what bodies leave of what the path carries
/// `tracer` has, for the path as it is in some of its frames:
///   void escaped(const State&, const FrameHit&)
///   void lost(const State&, int shape)                the surface is not finite
///   void arrived(const State&, const Arrival&)
template <class State, class Query, class Out, class Tracer>
constexpr void for_each_arrival(const PlainScene& scene, const Query& query, const State& path, Out& out,
                                const Tracer& tracer) {
  const HitPartition parts = query.partition(path.ray, path.frames);
  out.segment(path, parts);
  for (const FrameHit& part : parts) {
    State here = path;
    here.frames = part.frames;
    if (part.hit.missed()) {
      if (dim(scene.bodies, here, kInfinity, out)) tracer.escaped(here, part);
      continue;
    }
    const PlainPlacedShape& shape = scene.shape_of(part.hit);
    const SurfaceGeometry point = shape.surface_point(part.hit.primitive, part.hit.uv);
    if (!is_finite(point)) {
      tracer.lost(here, part.hit.shape);
      continue;
    }
    const bool from_within = leads_inside(shape.body, point.ng, -path.ray.direction);
    const MetSurface<PlainBody> met = scene.bodies.met(path.bodies.inside, shape.body, from_within, shape.emits);
    if (!met.is_there) {
      out.push(passed(here, point, shape.body, met.arriving, part.hit.t));
      continue;
    }
    FrameHit whole = part;
    whole.hit.t += path.bodies.passed;
    here.bodies.inside = met.arriving;
    if (!dim(scene.bodies, here, whole.hit.t, out)) continue;
    const bool differs = scene.differs_in(shape.material, part.frames);
    if (differs) out.part(path);
    tracer.arrived(here, {shape, whole, point, scene, met.around, differs});
  }
}

/// Returns the bodies of a path that leaves the surface in direction w.
constexpr BodiesOfPath bodies_beyond(const BodiesOfPath& arrived, const Arrival& at, const Vec3& wo, const Vec3& w) {
  return {inside_beyond(arrived.inside, at.shape.body, at.point.ng, wo, w), 0};
}

}  // namespace dspm
