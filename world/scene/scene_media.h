// The media of a scene, and where they begin and end.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "dspm/accel/accel.h"
#include "dspm/media/majorants.h"
#include "dspm/media/medium.h"
#include "dspm/world/scene/frame_states.h"
#include "dspm/world/scene/inside.h"

namespace dspm {

/// A medium with its states.
struct SceneMedium {
  FrameStates<Medium> states;
  FrameStates<Majorants> majorants;  // one for all frames of the file, but for variations that were added to it
  int light = -1;                    // into Scene::lights: what it gives off
};

/// The media on both sides of a surface: where its normal points to is outside.
struct MediumInterface {
  int inside = kNoMedium, outside = kNoMedium;  // into Scene::media

  int medium_towards(bool is_outside) const { return is_outside ? outside : inside; }
};

/// What a medium gives off. Camera paths see it on their way, and photons bring it to where they do not look for it.
struct Glow {
  int medium = kNoMedium;
  bool is_parted = false;  // some shape is a border of the medium
};

/// Where media begin and end without a surface that scatters light. Only paths in scenes with media ask for them.
struct MediumBoundaries {
  std::vector<PlacedShape> shapes;
  std::vector<MediumInterface> interfaces;  // by shape
  std::unique_ptr<Accel> accel;
};

}  // namespace dspm
