// Accelerator "two-level"
//
// The static tree answers for all frames at once, the dynamic tree for each frame; a ray traverses either at most once.
// [WG12, section 3; there rays restart after every dynamic hit]
//
//   string static   who builds the tree of what is static, and those of placed meshes: "embree" (large trees in a third
//                   of the time) or "own"; usually, Embree builds the large ones. It affects no pixel.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dspm/accel/accel.h"
#include "dspm/accel/tree.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/params/params.h"

namespace dspm {

class TwoLevel final : public Accel {
 public:
  TwoLevel(std::span<const PlacedShape> shapes, FrameSet all, BvhBuilder builder = BvhBuilder::by_size);

  HitPartition partition(const Ray& ray, FrameSet frames) const override;
  FrameSet occluded(const Ray& ray, FrameSet frames) const override;
  std::size_t memory() const override;
  std::unique_ptr<Accel> with(std::span<const PlacedShape> shapes, FrameSet all) const override;

  const Tree& static_tree() const { return static_; }
  const Tree& dynamic_tree() const { return dynamic_; }
  /// Those over the dynamic objects of one frame each; empty if there are none.
  std::span<const Tree> trees_of_frames() const { return of_frame_; }

 private:
  template <class Query>
  void find_dynamic(const TreeRay& ray, Query& query) const;

  struct Fixed;
  TwoLevel(std::shared_ptr<const Fixed> fixed, std::span<const PlacedShape> shapes, FrameSet all, BvhBuilder builder);

  TwoLevel(const TwoLevel& sooner, std::span<const PlacedShape> shapes);  // takes over its nodes

  BvhBuilder builder_;
  std::shared_ptr<const Fixed> fixed_;
  std::span<const PlacedShape> shapes_;
  MeshTrees meshes_;  // those that `fixed_` lacks
  const Tree& static_;
  Tree dynamic_;
  float margins_;  // for all of them
  // A path that has split is in few frames, often in one; its rays are faster in a tree over the dynamic objects of
  // that frame alone. Empty if such trees would hold too many copies of triangles.
  std::vector<Tree> of_frame_;
};

/// Does what AccelPlugin::bytes_at_most describes.
std::size_t two_level_bytes(std::span<const PlacedShape> shapes, FrameSet all);

std::unique_ptr<Accel> make_two_level(ParamReader& reader, std::span<const PlacedShape> shapes, FrameSet all);

}  // namespace dspm
