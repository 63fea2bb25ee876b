// Decides which frames of the file choose lights for their photon paths alike. Frames whose lights differ little do, so
// that they share these paths. Frames whose lights differ much do not, or each would get photons that light others.
#pragma once

#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/world/lighting/lighting.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct LightChoices {
  static constexpr std::size_t kMostChoices = 16;

  std::vector<int> of_frame;                      // by frame of the file: its choice
  std::size_t base = 0;                           // the number of first frames, which decide about the choices
  std::vector<std::vector<float>> probabilities;  // by choice and light

  /// The probability with which a photon path of the frame chooses the light.
  float probability(FileFrame frame, std::size_t light) const {
    return probabilities[static_cast<std::size_t>(of_frame[frame.slot()])][light];
  }
  /// Returns the choices in the scene of these frames.
  std::vector<LightChoice> in(const std::vector<FileFrame>& frames) const;
  /// Returns that many frames of the base, if there are so many, spread over it, and at least one of each choice.
  std::vector<FileFrame> sample(std::size_t wanted = kMostChoices) const;
  /// Returns SceneLight::choice_shares.
  std::vector<float> shares(const WorldLight& light) const;
};

/// Makes at most kMostChoices choices. The first `base` frames decide; the others take the choice that suits them best.
LightChoices make_light_choices(const std::vector<WorldLight>& lights, int base, int frames);

/// Makes the choices of the same frames at another time: alike are those that are in `others`, which has the base.
LightChoices make_light_choices(const std::vector<WorldLight>& lights, const LightChoices& others);

/// Returns how samples of direct light are shared out, by choice: by the mean power over its frames of the base.
std::vector<LightSamples> make_light_samples(const std::vector<WorldLight>& lights, const LightChoices& choices);

/// Returns each light's power times the scene's factor.
std::vector<double> weights_in(const std::vector<WorldLight>& lights, FileFrame frame);

/// Returns the fraction of photons with which the flux of lights of these powers would be as noisy if photon paths
/// chose them by power, as it is if they choose with these probabilities. 1 if all is dark.
double worth_of_choice(const std::vector<double>& powers, const std::vector<float>& probabilities);

}  // namespace dspm
