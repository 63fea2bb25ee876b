// The starts of one photon path: at a light for each choice of lights, once for all frames in which it starts alike.
#pragma once

#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/integrators/photons/photon_starts.h"
#include "dspm/integrators/photons/photon_writer.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct StartedPhoton {
  PhotonPath path;  // `start` is its place among the others
  PhotonOrigin from;
  const SceneLight::Alike* varied;  // not null: path's flux is that of the first of these states
  bool is_valid;                    // else the light is to blame in the path's frames
};

/// Replaces `started` by the starts of the path with these numbers. `wavelength` is that of the path.
void start_photons(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts,
                   const PathRandom& random, const Wavelength& wavelength, std::vector<StartedPhoton>& started);

/// Returns what a photon of that flux carries when it starts: if its light differs from state to state, in a spectral render a
/// grey that is never 0, as one state may have nothing at a wavelength that another has.
Spectrum carried_at_start(const PhotonStart& start, const Rgb& flux, const Palette& palette);
/// Returns what the photon carries in each state of the light, over what it does at its start. `flux` is what the first state
/// has emitted. Adds frames whose state gives no such light to `invalid`.
FrameArray<FrameFactor> weights_of_states(const Palette& palette, const SceneLight::Alike& alike, const Ray& start,
                                          const Rgb& flux, FrameSet& invalid);

}  // namespace dspm
