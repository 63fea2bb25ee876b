// A path that branches where frames part, traced to all its ends: the loop shared by camera paths, photons and gather
// rays.
#pragma once

#include <array>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/transport/body.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/medium_segment.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The branches of one path. follow() hands them to a tracer:
///   bool postpones(const Path&, const HitPartition&)      true: the tracer calls arrive() for these parts later
///   void arrived(const Path&, const Vertex&)              may push branches
///   void escaped(const Path&, FrameSet)
///   void lost(const Path&, FrameSet, const SceneElement&)    the surface is not finite; the shape to blame
///   void wandered(const Path& before, const Path& after)  optional: what the path carries has changed in a body or a medium
/// Surfaces that are not there, because a body of higher priority is (nesting.h), and boundaries of media end no segment: no
/// tracer knows of them. It may also have
///   void collided(), glowed() or beamed()                 by media, see medium_segment.h
///   StrandTable& strands()                                frames with different bodies then stay one path
///   void dimmed(const Path& before, const Path& after)    by the body that the segment has passed through
template <class AnyPath>
class BranchingPath {
 public:
  using Path = AnyPath;

  BranchingPath(const Scene& scene, PathCounts& counts) : scene_(scene), frames_(scene.frames()), counts_(counts) {}

  /// The new copy may be changed in place until the next push; drop() removes it.
  Path& push(const Path& branch) { return branches_[static_cast<std::size_t>(count_++)] = branch; }
  void drop() { --count_; }

  /// Runs until no branch is left.
  template <class Tracer>
  void follow(Tracer& tracer) {
    while (count_ > 0) {
      const Path path = branches_[static_cast<std::size_t>(--count_)];
      if (!scene_.media.empty() && !path.walk.is_inside()) {
        counts_.segments.add(path.frames.count());
        MediumSegment<BranchingPath>(*this, path, steps_).follow(tracer);
        continue;
      }
      const HitPartition parts = scene_.accel->partition(path.ray, path.frames);
      counts_.segments.add(path.frames.count());
      parted_ |= parts.size() > 1 || path.frames != frames_;
      if (tracer.postpones(path, parts)) continue;
      for (const FrameHit& part : parts) arrive(path, part, tracer);
    }
  }

  /// Hands one part of the hit partition to the tracer.
  template <class Tracer>
  void arrive(const Path& path, const FrameHit& part, Tracer& tracer) {
    if (path.walk.is_inside()) return wander(path, part, tracer);
    const auto escape = [&](const Path& left) { tracer.escaped(left, left.frames); };
    if (part.hit.missed() && !path.inside.is_empty())
      return dim(path, path.inside, part.frames, kInfinity, tracer, escape);
    if (part.hit.missed()) return tracer.escaped(path, part.frames);
    arrive_at_surface(path, part, tracer);
  }

  /// Counts a path. Called once, after all of its branches have ended.
  void count_path() {
    ++counts_.paths;
    counts_.dynamic_paths += parted_;
    parted_ = false;
  }

 private:
  friend MediumSegment<BranchingPath>;

  template <class Tracer>
  void arrive_at_surface(const Path& path, const FrameHit& part, Tracer& tracer) {
    FrameHit whole = part;  // with the whole length of the segment
    whole.hit.t += path.passed;
    Vertex vertex(scene_, path.ray, whole, path.diameter(whole.hit.t));
    vertex.point.wavelength = path.wavelength;
    parted_ |= vertex.differs();
    if (!is_finite(vertex.point)) return tracer.lost(path, part.frames, vertex.shape_element());
    const auto show = [&](const Path& arrived, const Vertex& met) {
      for_each_relief(met, [&](const Vertex& shown) { tracer.arrived(arrived, shown); });
    };
    if (path.inside.is_empty() && !vertex.leads_inside(vertex.wo)) return show(path, vertex);
    for (const Boundary& boundary : boundaries_of(scene_, vertex, path.inside)) {
      if (!boundary.is_there) {
        pass(path, vertex, boundary, part.hit.t);
        continue;
      }
      dim(path, boundary.arriving, boundary.frames, whole.hit.t, tracer, [&](const Path& left) {
        Vertex met = vertex;
        met.frames = left.frames, met.point.outside_eta = boundary.outside_eta;
        met.point.outside_dispersion = boundary.outside_dispersion;
        show(left, met);
      });
    }
  }

  /// Sends the path straight on through a surface that is not there, `distance` along its ray.
  void pass(const Path& path, const Vertex& vertex, const Boundary& boundary, float distance) {
    Path& on = push(path);
    on.frames = boundary.frames, on.ray = beyond(path.ray, vertex, distance);
    on.inside = vertex.inside_beyond(boundary.arriving, path.ray.direction), on.passed += distance;
    parted_ |= boundary.frames != vertex.frames;
  }

  /// Sends a walking path straight on; returns the frames in which the surface is not there.
  template <class Tracer>
  FrameSet pass_walking(const Path& path, const FrameHit& part, Tracer& tracer) {
    FrameSet passing;
    if (part.hit.missed() || !scene_.nests) return passing;
    const Vertex vertex(scene_, path.ray, part);
    if (!is_finite(vertex.point)) return passing;
    for (const Boundary& boundary : boundaries_of(scene_, vertex, path.inside)) {
      if (boundary.is_there) continue;
      passing |= boundary.frames;
      Path after = path;
      after.frames = boundary.frames, after.throughput *= after.walk.reach(part.hit.t);
      if constexpr (requires { tracer.wandered(path, after); }) tracer.wandered(path, after);
      pass(after, vertex, boundary, part.hit.t);
    }
    return passing;
  }

  /// A path inside a body is scattered there if its ray ends before the surface, and may be thrown back by the surface.
  /// No tracer knows of these vertices.
  template <class Tracer>
  void wander(const Path& path, const FrameHit& part, Tracer& tracer) {
    Path after = path;
    after.frames = part.frames - pass_walking(path, part, tracer);
    if (after.frames.empty()) return;
    bool stays = part.hit.missed();
    if (stays)
      after.throughput *= is_lost(after.ray) ? Spectrum() : after.walk.scatter(after.ray, after.random, after.bounces);
    else
      after.throughput *= after.walk.reach(part.hit.t);
    if constexpr (requires { tracer.wandered(path, after); }) tracer.wandered(path, after);
    if (is_black(after.throughput)) return;
    if (!stays) {
      const SurfacePoint point = scene_.surface_point(part.hit, after.ray.direction);
      const bool leaves = is_finite(point) && dot(point.ng, path.ray.direction) > 0;
      stays = leaves && after.walk.is_thrown_back(after.ray, point, -point.ng, after.random, after.bounces);
    }
    if (stays)
      push(after);
    else
      arrive_at_surface(after, {after.frames, part.hit}, tracer);
  }
  /// Returns whether the ray is far outside, after a hole in the body's surface let it out.
  bool is_lost(const Ray& ray) const {
    return !(length2(ray.at(ray.t_max) - scene_.center) < 4 * scene_.radius * scene_.radius);
  }

  /// Calls fn(const Path&) for what arrives, in these frames, of a path whose segment lies in these bodies: for one
  /// path if the tracer has strands.
  template <class Tracer, class Fn>
  void dim(const Path& path, const Inside& inside, FrameSet frames, float distance, Tracer& tracer, Fn&& fn) {
    Path left = path;
    left.inside = inside, left.frames = frames;
    if (inside.is_empty()) return fn(left);
    const FrameArray<FrameFactor> factors = left_within(scene_, inside, frames, distance);
    if constexpr (requires { tracer.strands(); }) {
      const Path before = left;
      const bool any = multiply(left, factors, tracer.strands(), ByRatio::yes, keep_all);
      if (!any) left.frames = {};
      if constexpr (requires { tracer.dimmed(before, left); }) tracer.dimmed(before, left);
      if (any) fn(left);
    } else {
      for (const FrameFactor& f : factors) {
        left.frames = f.frames, left.throughput = path.throughput * f.factor;
        if (!is_black(left.throughput)) fn(left);
      }
    }
  }

  const Scene& scene_;
  FrameSet frames_;
  PathCounts& counts_;
  std::vector<MediumStep> steps_;          // of the passage at hand
  std::array<Path, kMaxFrames> branches_;  // disjoint frame sets, so never more branches than frames
  int count_ = 0;
  bool parted_ = false;  // the path has met something that differs between frames
};

}  // namespace dspm
