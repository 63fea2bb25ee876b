// Turns the description (plain data) into objects: everything that a scene file says about geometry, looks, light and
// camera, made once for all frames of the file; the scenes of frame intervals are cut from it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class KeptGeometry;

struct WorldOptions {
  int width = 1, height = 1;  // of the full image, for the camera
  std::string accel = {};     // a plugin's name; empty: what the scene says, else two-level
  bool check_meshes = true;   // look for holes and self-intersections in meshes that bound a body
  float film_diagonal = CameraContext().film_diagonal;
  KeptGeometry* kept = nullptr;                      // of scenes before, and for those to come; outlives the world
  const std::vector<FileFrame>* rendered = nullptr;  // ascending, of the file's frames; null: all
  bool blurs = false;                                // after() will be called
  bool nearby = false;                               // scenes have Scene::nearby
};

/// The camera's place in a frame, and what it does to points.
struct CameraMatrices {
  Matrix4 camera_from_world;
  std::optional<Matrix4> image_from_world;  // see Camera::image_from_camera
};

class World {
 public:
  /// Reports errors and warnings to `diagnostics`; after an error, scenes cannot be made. `description` outlives it.
  World(const SceneDescription& description, const WorldOptions& options, Diagnostics& diagnostics);
  ~World();

  /// Makes the world so many frames later; it shares what it can with this one, which outlives it. Throws SceneError.
  std::unique_ptr<World> after(double delay, Diagnostics* notes = nullptr) const;  // adds those that are new
  bool has_velocities() const;                                                     // see Geometry
  /// Makes the scene of these frames of the file: ascending, at most kMaxFrames. The world must outlive its scenes. All
  /// scenes of a world agree on what sampling derives from the scene (light probabilities, bounding sphere). `sooner` is
  /// that of the world that this one is after, and outlives the scene; null if there is none.
  std::unique_ptr<Scene> scene(std::span<const FileFrame> frames, const Scene* sooner = nullptr) const;
  std::vector<FileFrame> sample_frames() const;  // at most 16, spread over the file
  /// Returns a text that is equal if sampling is the same: what the file's first frames decide of it.
  std::string sampling() const;
  /// Returns the directive that an element of scene(frames) comes from, in its frame j.
  const PluginUse& use_of(const SceneElement& element, std::span<const FileFrame> frames, Frame j) const;
  CameraMatrices camera_matrices(FileFrame frame) const;
  /// What may be elsewhere in after() worlds, and the cameras, without a scene around them. The world outlives them.
  std::vector<PlacedShape> moving_shapes(std::span<const FileFrame> frames) const;
  FrameStates<Camera> cameras(std::span<const FileFrame> frames) const;
  /// The number of pictures in memory for textures: those of this world's scenes, and those that the world keeps.
  int pictures_held() const;
  /// Returns an upper estimate of the bytes that the trees of that scene take while it is made, without making it.
  std::size_t tree_bytes_at_most(std::span<const FileFrame> frames) const;
  /// Explains what is shared between frames and what is not, and why: one sentence per line, for --explain.
  std::vector<std::string> explain(std::span<const FileFrame> frames) const;

 private:
  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dspm
