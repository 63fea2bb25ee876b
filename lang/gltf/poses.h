// The places of a document's nodes, frame by frame.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "dspm/base/math/transform.h"
#include "dspm/lang/gltf/animation.h"

namespace dspm::gltf {

/// A node's own transform: translation, rotation (a quaternion x y z w), scale; or a matrix.
struct Pose {
  std::array<double, 3> translation{0, 0, 0};
  std::array<double, 4> rotation{0, 0, 0, 1};
  std::array<double, 3> scale{1, 1, 1};
  std::optional<std::array<double, 16>> matrix;  // by columns
  std::vector<double> weights;                   // of morph targets
  bool visible = true;

  bool is_at_place_of(const Pose& other) const {
    return translation == other.translation && rotation == other.rotation && scale == other.scale &&
           matrix == other.matrix;
  }
  /// Returns the rotation in degrees around an axis of unit length.
  std::array<double, 4> turn() const;
  Matrix4 transform() const;
};

/// Keeps a scale away from 0, which has no inverse.
inline double with_inverse(double scale) { return std::abs(scale) < 1e-5 ? std::copysign(1e-5, scale) : scale; }

class Poses {
 public:
  /// Checks that nodes form trees. Throws std::runtime_error.
  Poses(const Document& document, const Animation& animation, int frames, double fps);
  /// The same for a frame at each of these times, in seconds.
  Poses(const Document& document, const Animation& animation, const std::vector<double>& times);

  int frames() const { return frames_; }
  const Pose& at(std::size_t node, int frame) const;
  /// Returns whether the node moves by its own transform.
  bool moves(std::size_t node) const;
  bool changes_weights(std::size_t node) const;
  bool changes_visibility(std::size_t node) const;
  std::optional<std::size_t> parent(std::size_t node) const { return parents_[node]; }
  Matrix4 world(std::size_t node, int frame) const;
  /// Returns a matrix for each joint of skins/index, from the mesh's place to the world.
  std::vector<Matrix4> skin(const Document& document, std::size_t index, int frame) const;
  /// Returns whether the skin is the same in all frames.
  bool skin_rests(const Document& document, std::size_t index) const;

 private:
  int frames_;
  std::vector<std::optional<std::size_t>> parents_;
  std::vector<std::vector<Pose>> poses_;  // by node: one, or one for each frame
};

/// Returns how many frames there are from the time 0 to the end. Throws std::runtime_error if they are more than
/// `most`.
int frames_of(double duration, double fps, int most);

}  // namespace dspm::gltf
