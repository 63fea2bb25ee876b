// The finished scene of one frame interval (the frames rendered together): all that an integrator may query. Everything
// is const, and frames count from 0 at the first frame that is rendered.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dspm/accel/accel.h"
#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/camera.h"
#include "dspm/lights/light.h"
#include "dspm/materials/material.h"
#include "dspm/world/scene/frame_states.h"
#include "dspm/world/scene/inside.h"
#include "dspm/world/scene/light_samples.h"
#include "dspm/world/scene/scene_media.h"

namespace dspm {

class NearbyMoments;

/// A factor by which frames differ from others.
struct FrameFactor {
  FrameSet frames;
  Spectrum factor;
};

/// A light with its states.
struct SceneLight {
  /// States whose photons start like those of `first`, a state of the file, times a weight.
  struct Alike {
    std::shared_ptr<const Light> first;
    std::vector<FrameStates<Light>::State> states;
    /// Each state's Light::ratio_to(first); empty if the ratio depends on a photon's direction.
    std::vector<FrameFactor> factors;
  };
  FrameStates<Light> states;
  float probability = 0;     // its mean power over all frames of the file, over that of all
  std::vector<Alike> alike;  // all states, grouped
  bool is_delta = false;     // no ray can hit it: it has no surface and is not infinite
  float photons = 1;         // the scene's factor to its share of the photon paths
  bool caustics = true;      // false: its photons end where they would go on to a caustic
  /// The shares of the file's frames with this light, by Scene::light_choices; they add up to 1. Weights take the
  /// density of a photon's start as the mean with these shares.
  std::vector<float> choice_shares;
  int group = 0;               // into Scene::light_groups
  MediumInterface media = {};  // of its surface; without one, it is outside
  Glow glow = {};              // of a medium: no shadow ray looks for it
  // None of its light arrives: it is infinitely far away, beyond a medium without end, or a medium that is not there.
  bool is_drowned = false;
};

struct ChosenLight {
  int index;
  float probability;
};

/// Frames whose photon paths choose lights alike: in proportion to mean power over these frames of the file, times
/// SceneLight::photons. Other frames start paths of their own, with the same random numbers.
class LightChoice {
 public:
  explicit LightChoice(std::vector<float> probability);

  /// Returns a light of probability 0 if there are no lights.
  ChosenLight choose(float u) const;
  const std::vector<float>& probability() const { return probability_; }

  FrameSet frames;
  float share = 1;  // of the file's frames

 private:
  std::vector<float> probability_;  // by light
  std::vector<float> sums_;         // up to and with each light
};

/// A scene element made by a plugin, for messages.
struct SceneElement {
  enum class Kind { camera, shape, material, light, medium };
  Kind kind;
  int index = 0;  // into the scene's shapes, materials, lights or media
  friend bool operator==(const SceneElement&, const SceneElement&) = default;
};

class Scene {
 public:
  std::vector<FileFrame> file_frames;  // by frame: which of the file it is; ascending, at most kMaxFrames
  Vec3 center;                         // bounding sphere over all frames of the file
  float radius = 1;

  /// What the paths of the iteration at hand carry.
  std::shared_ptr<const Palette> palette{std::shared_ptr<const Palette>(), &Palette::rgb()};

  std::vector<PlacedShape> shapes;
  /// The distinct names of objects: what the scene file calls one thing, perhaps several shapes.
  std::span<const std::string> object_names;
  std::vector<FrameStates<Material>> materials;
  std::span<const std::string> material_names;  // distinct
  /// By material: whether its shapes bound a body in some frame. Empty if no path needs to know the bodies around it.
  std::vector<bool> bounds_bodies;
  bool nests = false;                       // bodies differ in priority: where they overlap, one of them is not there
  bool disperses = false;                   // some body refracts light by its wavelength
  std::vector<SceneMedium> media;           // empty: light meets nothing between surfaces
  std::vector<MediumInterface> interfaces;  // distinct ones of surfaces
  std::vector<int> interface_of;            // by shape: into `interfaces`; -1: the same medium on both sides
  std::unique_ptr<const MediumBoundaries> boundaries;  // null: none
  /// The bodies and the medium that the camera lies in; the sets are disjoint, and cover all frames if there are any.
  struct AroundCamera {
    FrameSet frames;
    Inside inside;
  };
  std::vector<AroundCamera> around_camera;
  std::vector<SceneLight> lights;
  std::vector<LightChoice> light_choices;      // of the file; their frames here are disjoint, and all frames in the end
  std::span<const LightSamples> direct_light;  // of the frames of each choice
  std::span<const std::string> light_names;    // distinct
  std::span<const std::string> light_groups;   // distinct; the first is that of lights without a group of their own
  std::vector<int> infinite_lights;            // those that implement escaped()
  FrameStates<Camera> camera;
  std::vector<Transform> camera_to_world;              // by frame
  std::shared_ptr<const NearbyMoments> nearby;         // null unless WorldOptions::nearby
  std::vector<std::shared_ptr<const Cutout>> cutouts;  // of shapes
  std::unique_ptr<Accel> accel;
  std::vector<bool> catchers;  // by shape: whether it only shows how others change its light; empty: none in the file
  /// The same frames with nothing but the catchers and what emits light; null if the file has no catchers.
  std::unique_ptr<Scene> without_objects;
  bool is_without_objects = false;

  int frame_count() const { return static_cast<int>(file_frames.size()); }
  bool is_catcher(int shape) const { return !catchers.empty() && catchers[static_cast<std::size_t>(shape)]; }
  FrameSet frames() const { return FrameSet::first(frame_count()); }
  /// Returns the material if its shapes bound a body that paths need to know, else kNoBody.
  int body_of(int material) const {
    return !bounds_bodies.empty() && bounds_bodies[static_cast<std::size_t>(material)] ? material : kNoBody;
  }
  /// Returns what media the shape parts; null if it lies within one, or within none.
  const MediumInterface* interface_at(int shape) const {
    if (interface_of.empty()) return nullptr;
    const int index = interface_of[static_cast<std::size_t>(shape)];
    return index < 0 ? nullptr : &interfaces[static_cast<std::size_t>(index)];
  }
  /// Sets the palette; whoever asks for iterations of a spectral render does so before each.
  void set_palette(const std::shared_ptr<const Palette>& of_iteration);
  /// Returns the wavelength of all paths of an iteration, as Wavelength::nm says; 0 if no body refracts by it.
  std::int16_t nm_of(std::uint64_t seed, std::uint64_t iteration) const;
  /// Returns the surface where a ray of that direction hit.
  SurfacePoint surface_point(const RayHit& hit, const Vec3& direction) const {
    return shapes[static_cast<std::size_t>(hit.shape)].seen(hit.primitive, hit.uv, direction);
  }
};

}  // namespace dspm
