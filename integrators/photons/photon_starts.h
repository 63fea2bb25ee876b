// Starts photon paths at the lights: together in all frames whose photons differ at most in colour.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/integrators/transport/strand.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// A path that starts whenever its frames choose the light.
struct PhotonStart {
  const Light* light;
  FrameSet frames;
  Spectrum factor;  // of the light's flux
  StrandList strands;
  const SceneLight::Alike* varied = nullptr;  // set if each photon weighs its states anew
  Inside inside = {};                         // the bodies in which the light lies, all of it
};

class PhotonStarts {
 public:
  /// Starts frames whose lights differ only in strength or colour together, if share_paths.
  PhotonStarts(const Scene& scene, bool share_paths);
  const std::vector<PhotonStart>& of(std::size_t choice, int light) const {
    return of_choice_[choice][static_cast<std::size_t>(light)];
  }
  /// The strands that paths start with: the first lists of every trace.
  const StrandTable& strands() const { return strands_; }

 private:
  std::vector<PhotonStart> starts_of(const SceneLight& light, FrameSet frames, bool share_paths,
                                     const Palette& palette);
  void add(const Light& light, std::span<const FrameFactor> factors, FrameSet frames, std::vector<PhotonStart>& starts);

  std::vector<std::vector<std::vector<PhotonStart>>> of_choice_;  // by light
  StrandTable strands_;
};

}  // namespace dspm
