// Accelerator "two-level"
//
// The static tree answers for all frames at once, the dynamic tree for each frame; a ray asks both once. It has no
// parameters. [WG12, section 3; there rays start anew behind every dynamic hit]
#pragma once

#include "accel/dynamic_tree.h"
#include "accel/static_tree.h"

namespace dspm {

/// Numbers of the placed shapes that are there in all of the frames, and in some.
ShapesByKind static_shapes(std::span<const PlacedShape> shapes, FrameSet all);
ShapesByKind dynamic_shapes(std::span<const PlacedShape> shapes, FrameSet all);

class TwoLevel final : public Accel {
 public:
  TwoLevel(std::span<const PlacedShape> shapes, FrameSet all);

  HitPartition partition(const Ray& ray, FrameSet frames) const override;
  FrameSet occluded(const Ray& ray, FrameSet frames) const override;
  std::size_t memory() const override { return static_.memory() + dynamic_.memory(); }

  const StaticTree& static_tree() const { return static_; }
  const DynamicTree& dynamic_tree() const { return dynamic_; }

 private:
  RayHit nearest(const Ray& ray, FrameSet frames) const;

  StaticTree static_;
  DynamicTree dynamic_;
};

std::unique_ptr<Accel> make_two_level(ParamReader& reader, std::span<const PlacedShape> shapes, FrameSet all);

}  // namespace dspm
