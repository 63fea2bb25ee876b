// A box that holds a moving mesh in all of its poses, without posing it.
#pragma once

#include <vector>

#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/lang/gltf/primitive.h"

namespace dspm::gltf {

/// Boxes of the vertices that hang on one joint each, and of what morph targets add to them. A skinned vertex is a
/// weighted mean of what its joints make of it, so it lies in the box of all that the joints make of their boxes.
class PosedBoxes {
 public:
  /// `rest` has positions, and joints within the skin.
  explicit PosedBoxes(const Primitive& rest);

  /// Returns a box that holds what pose() makes of the positions.
  Bounds3 posed(const std::vector<double>& weights, const std::vector<Matrix4>& skin) const;

 private:
  struct Group {
    std::size_t joint;
    Bounds3 rest;
    std::vector<Bounds3> targets;
  };
  static constexpr std::size_t kStill = static_cast<std::size_t>(-1);  // of vertices that hang on no joint

  void add(const Primitive& rest, std::size_t vertex, std::size_t joint);

  std::vector<Group> groups_;
};

}  // namespace dspm::gltf
