// Makes the plain scene of a scene, and owns what it points to beside the scene's own trees and meshes; or says what of the
// scene has no plain form.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "dspm/accel/plain_trees.h"
#include "dspm/integrators/waves/plain_bodies.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/materials/plain_material.h"
#include "dspm/materials/refractive_index.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns all that keeps paths in the scene from being traced in waves, each once, in words that follow "because"; none if
/// nothing does.
std::vector<std::string> reasons_not_plain(const Scene& scene);
/// Returns the first of them, or an empty string.
std::string why_not_plain(const Scene& scene);
/// Returns whether frames differ in the material of some shape. In waves they part there.
bool looks_differ(const Scene& scene);

class PlainObjects {
 public:
  /// `scene`, which is plain, must outlive this.
  explicit PlainObjects(const Scene& scene);

  const PlainScene& scene() const { return plain_; }

 private:
  void find_bodies(const Scene& scene);
  /// Returns what the body is to those that lie in it, a place among surroundings_.
  int surroundings_of(const Material& body);
  /// Returns the material as it is in these surroundings.
  PlainMaterial plain_material(const Scene& scene, std::size_t material, std::size_t around) const;
  bool may_lie_within(std::size_t material, std::size_t around) const;
  /// Adds the states of materials that differ between frames.
  void add_states(const Scene& scene);

  PlainTrees trees_;
  std::deque<PlainTexture<float>> alphas_;
  std::vector<PlainPlacedShape> shapes_;
  std::vector<PlainMaterial> materials_;      // see PlainScene
  std::vector<PlainState> states_;            // likewise
  std::vector<PlainBody> bodies_;             // likewise
  std::vector<PlainIndex> surroundings_;      // likewise
  std::vector<std::vector<float>> by_nm_{1};  // that they point to; the first is empty
  PlainScene plain_;
};

}  // namespace dspm
