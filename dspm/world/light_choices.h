// Which frames of the file choose lights for their photon paths alike. Frames whose lights differ little do, so that they
// share these paths. Frames whose lights differ much do not, or each would get photons that light others.
#pragma once

#include <vector>

#include "dspm/math/frames.h"
#include "dspm/scene/scene.h"
#include "dspm/world/lighting.h"

namespace dspm {

struct LightChoices {
  static constexpr std::size_t kMostChoices = 16;

  std::vector<int> of_frame;                      // by frame of the file: its choice
  std::size_t base = 0;                           // so many frames decide about the choices, the first ones
  std::vector<std::vector<float>> probabilities;  // by choice and light

  /// Of a photon path.
  float probability(FileFrame frame, std::size_t light) const {
    return probabilities[static_cast<std::size_t>(of_frame[frame.slot()])][light];
  }
  /// In the scene of these frames.
  std::vector<LightChoice> in(const std::vector<FileFrame>& frames) const;
  /// At most kMostChoices frames, spread over the base, and one of each choice at least.
  std::vector<FileFrame> sample() const;
  /// See SceneLight::choice_shares.
  std::vector<float> shares(const WorldLight& light) const;
};

/// At most kMostChoices. The first `base` frames decide; the others take the choice that suits them best.
LightChoices make_light_choices(const std::vector<WorldLight>& lights, int base, int frames);

/// By light: power times the scene's factor.
std::vector<double> weights_in(const std::vector<WorldLight>& lights, FileFrame frame);

/// The flux of lights of such powers is as noisy, if photon paths choose them with such probabilities, as with this
/// fraction of the photons if they chose by power. 1 if all is dark.
double worth_of_choice(const std::vector<double>& powers, const std::vector<float>& probabilities);

}  // namespace dspm
