// The query on which everything is built: what does a ray meet first in each of these frames?
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

/// A ray's intersection. `shape` indexes the placed shapes and is negative for a miss.
struct RayHit {
  float t = kInfinity;
  int shape = -1;
  int primitive = 0;
  Vec2 uv;

  bool missed() const { return shape < 0; }
  /// The order that decides which of two hits is nearer: distance, then shape, then primitive.
  bool nearer_than(const RayHit& o) const {
    if (t != o.t) return t < o.t;
    if (shape != o.shape) return static_cast<unsigned>(shape) < static_cast<unsigned>(o.shape);
    return primitive < o.primitive;
  }
};

/// The ray's first hit (or a miss) in these frames.
struct FrameHit {
  FrameSet frames;
  RayHit hit;
};

/// The frames of a ray partitioned by its first hit: parts are disjoint, their union is the query's frames, a miss is a
/// part, and no two parts have the same (shape, primitive). Parts are sorted by their lowest frames.
class HitPartition {
 public:
  void add(FrameSet frames, const RayHit& hit) { parts_.add({frames, hit}); }
  int size() const { return static_cast<int>(parts_.size()); }
  FrameHit& operator[](int i) { return parts_[static_cast<std::size_t>(i)]; }
  const FrameHit& operator[](int i) const { return parts_[static_cast<std::size_t>(i)]; }
  const FrameHit* begin() const { return parts_.begin(); }
  const FrameHit* end() const { return parts_.end(); }

 private:
  FrameArray<FrameHit> parts_;
};

class Accel {
 public:
  virtual ~Accel() = default;
  /// The nearest hit with t in (0, ray.t_max), frame by frame.
  virtual HitPartition partition(const Ray& ray, FrameSet frames) const = 0;
  /// The frames in which something lies in (0, ray.t_max).
  virtual FrameSet occluded(const Ray& ray, FrameSet frames) const = 0;
  /// The bytes that the tree holds, for the report before rendering.
  virtual std::size_t memory() const = 0;
  /// Returns a tree over the shapes of the same frames at another time, or after an edit, that shares with this one what
  /// is the same in both; this one and its shapes outlive it. Null: it shares nothing, a tree has to be made anew.
  virtual std::unique_ptr<Accel> with(std::span<const PlacedShape> /*shapes*/, FrameSet /*all*/) const {
    return nullptr;
  }
};

/// `shapes` and the objects they point to must outlive the tree; `all` are the frames of the interval: a shape that
/// exists in all of them is static.
using MakeAccel = std::unique_ptr<Accel>(ParamReader&, std::span<const PlacedShape> shapes, FrameSet all);
struct AccelPlugin : Plugin<MakeAccel> {
  /// Returns an upper estimate of the tree's peak size while it is built, without building it.
  std::size_t (*bytes_at_most)(std::span<const PlacedShape> shapes, FrameSet all);
};
PluginTable<AccelPlugin>& accel_plugins();

}  // namespace dspm
