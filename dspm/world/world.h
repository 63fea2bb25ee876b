// From the description (plain data) to objects: everything a scene file says about geometry, looks, light and camera,
// made once for all frames of the file; the scenes of frame intervals are cut from it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dspm/lang/description.h"
#include "dspm/math/frames.h"
#include "dspm/params/errors.h"
#include "dspm/scene/scene.h"

namespace dspm {

struct WorldOptions {
  int width = 1, height = 1;  // of the full image, for the camera
  std::string accel;          // a plugin's name; empty: what the scene says, else two-level
  bool check_meshes = true;   // look for holes and self-intersections in meshes that bound a body
};

class World {
 public:
  /// Everything wrong with the scene goes to `diagnostics`; where errors come up, scenes cannot be made.
  /// `description` must outlive the world.
  World(const SceneDescription& description, const WorldOptions& options, Diagnostics& diagnostics);
  ~World();

  int frame_count() const;
  /// The scene of these frames of the file: ascending, at most kMaxFrames. The world outlives its scenes. All scenes of
  /// a world agree in what sampling derives from the scene (light probabilities, bounding sphere).
  std::unique_ptr<Scene> scene(std::span<const Frame> frames) const;
  /// The directive that made a part of scene(frames), as frame j of it has it.
  const PluginUse& use_of(const ScenePart& part, std::span<const Frame> frames, Frame j) const;
  /// How many pictures the textures hold of those that are made: those of this world's scenes, and what all need.
  int pictures_held() const;
  /// What the trees of that scene may take at most while it is made, in bytes: an estimate, without making it.
  std::size_t tree_bytes_at_most(std::span<const Frame> frames) const;
  /// What is shared between frames and what is not, and why: a sentence a line, for --explain.
  std::vector<std::string> explain(std::span<const Frame> frames) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace dspm
