// A path that branches where frames part, followed to its ends: the one loop of camera paths, photons and gather rays.
#pragma once

#include "dspm/integrators/path_step.h"
#include "dspm/integrators/statistics.h"
#include "dspm/math/frames.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// Branches of one path, to be followed by a tracer:
///   bool postpones(const Path&, const HitPartition&)      true: the tracer follows these parts later, by arrive()
///   void arrived(const Path&, const Vertex&)              may push branches
///   void escaped(const Path&, FrameSet)
///   void lost(const Path&, FrameSet, const ScenePart&)    the surface is not finite, and whose fault that is
template <class Path>
class BranchingPath {
 public:
  BranchingPath(const Scene& scene, PathCounts& counts) : scene_(scene), frames_(scene.frames()), counts_(counts) {}

  /// The branch's copy, to be changed in place until the next push; drop() takes it back.
  Path& push(const Path& branch) { return branches_[static_cast<std::size_t>(count_++)] = branch; }
  void drop() { --count_; }

  /// Until no branch is left.
  template <class Tracer>
  void follow(Tracer& tracer) {
    while (count_ > 0) {
      const Path path = branches_[static_cast<std::size_t>(--count_)];
      const HitPartition parts = scene_.accel->partition(path.ray, path.frames);
      counts_.segments.add(path.frames.count());
      parted_ |= parts.size() > 1 || path.frames != frames_;
      if (tracer.postpones(path, parts)) continue;
      for (const FrameHit& part : parts) arrive(path, part, tracer);
    }
  }

  /// Hands one part of what the branch meets to the tracer.
  template <class Tracer>
  void arrive(const Path& path, const FrameHit& part, Tracer& tracer) {
    if (part.hit.missed()) return tracer.escaped(path, part.frames);
    const Vertex vertex(scene_, path.ray, part);
    parted_ |= vertex.differs();
    if (is_finite(vertex.point)) return tracer.arrived(path, vertex);
    tracer.lost(path, part.frames, vertex.shape_part());
  }

  /// Once a path has come to all its ends: counts it.
  void count_path() {
    ++counts_.paths;
    counts_.dynamic_paths += parted_;
    parted_ = false;
  }

 private:
  const Scene& scene_;
  FrameSet frames_;
  PathCounts& counts_;
  std::array<Path, kMaxFrames> branches_;  // their sets are disjoint, so there are never more than frames
  int count_ = 0;
  bool parted_ = false;  // the path has met something that is not the same in all frames
};

}  // namespace dspm
