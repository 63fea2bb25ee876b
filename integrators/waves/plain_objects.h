// Makes the plain scene of a scene, and owns what it points to beside the scene's own trees and meshes; or says what of the
// scene has no plain form.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "dspm/accel/plain_trees.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns what keeps paths in the scene from being traced in waves, in words that follow "because"; empty if nothing
/// does.
std::string why_not_plain(const Scene& scene);

class PlainObjects {
 public:
  /// `scene`, which is plain, must outlive this.
  explicit PlainObjects(const Scene& scene);

  const PlainScene& scene() const { return plain_; }

 private:
  PlainTrees trees_;
  std::deque<PlainTexture<float>> alphas_;
  std::vector<PlainPlacedShape> shapes_;
  std::vector<PlainMaterial> materials_;
  PlainScene plain_;
};

}  // namespace dspm
