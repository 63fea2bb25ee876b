// The query on which everything is built: what does a ray meet first in each of these frames?
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

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
