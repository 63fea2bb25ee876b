// The data that all parts of one iteration of vertex connection and merging share.
#pragma once

#include <cstdint>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/methods/vcm/subpath_weights.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/transport/lobe_choice.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct VcmSettings {
  int iterations = 256;
  int photons = 1;  // light subpaths per iteration
  int max_depth = 8;
  float radius = 0;  // initial
  float alpha = 0.75f;
  bool connect = true, merge = true, sight = true;
  bool share_paths = true;
  bool guided = true;  // light paths start where pilot paths were found; else by the lights' power
};

struct VcmPass {
  const Scene& scene;
  const RenderSettings& render;
  const VcmSettings& settings;
  std::uint64_t iteration;
  float radius;  // of merging on surfaces, the same everywhere and in all frames
  float radius_in_media;
  VcmWays ways;
  const EmissionGuides* guides = nullptr;  // of light paths' starts; null or off: by power
  std::int16_t nm = 0;                     // the iteration's wavelength, if the scene disperses
};

/// The way in which a subpath is scattered in some of its frames. Frames stay together only if all their densities are
/// the same.
struct SubpathScattering {
  FrameSet frames;
  Spectrum factor;
  BsdfSample sample;
  float reverse_pdf_w;

  std::optional<Spectrum> along(const SubpathScattering& first) const {
    const BsdfSample& s = first.sample;
    const bool same = sample.wi == s.wi && sample.specular == s.specular && sample.eta_scale == s.eta_scale &&
                      sample.ahead == s.ahead && sample.by_wavelength == s.by_wavelength && sample.pdf_w == s.pdf_w &&
                      reverse_pdf_w == first.reverse_pdf_w;
    return same ? std::optional(factor) : std::nullopt;
  }
};

/// Returns nullopt if the light is absorbed. The factor is the sample's weight.
inline std::optional<SubpathScattering> scatter(const PathState& path, const Vec3& wo, FrameSet frames,
                                                const Bsdf& bsdf, Transport transport) {
  const LobeSet lobes = bsdf.all_lobes();
  const auto sample = sample_bsdf(bsdf, path, wo, transport, lobes);
  if (!sample) return std::nullopt;
  const Transport back = transport == Transport::flux ? Transport::radiance : Transport::flux;
  const float reverse = sample->specular ? 0 : bsdf.pdf_w(sample->wi, wo, back, lobes);
  return SubpathScattering{frames, sample->weight, *sample, reverse};
}

/// Returns whether paths can be connected or merged here.
inline bool can_connect(const Bsdf& bsdf) { return bsdf.lobes(kLeastRoughness) != 0; }

}  // namespace dspm
