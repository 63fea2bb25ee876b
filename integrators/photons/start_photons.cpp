#include "dspm/integrators/photons/start_photons.h"

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/seen_along.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/medium_boundary.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

Spectrum carried_at_start(const PhotonStart& start, const Rgb& flux, const Palette& palette) {
  if (start.varied == nullptr || palette.is_rgb()) return start.light->carried(flux, palette);
  return Spectrum(max_component(flux));
}

void start_photons(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts,
                   const PathRandom& random, const Wavelength& wavelength, std::vector<StartedPhoton>& started) {
  started.clear();
  for (std::size_t choice = 0; choice < scene.light_choices.size(); ++choice) {
    if ((scene.light_choices[choice].frames & settings.frames).empty()) continue;
    const EmissionStart chosen = start_of(settings.guides, scene, choice, random);
    if (chosen.density == 0) continue;
    const SceneLight& light = scene.lights[static_cast<std::size_t>(chosen.light)];
    if (light.is_drowned) continue;
    const EmissionNumbers& u = chosen.numbers;
    for (const PhotonStart& start : starts.of(choice, chosen.light)) {
      FrameSet frames = start.frames & settings.frames;
      if (frames.empty()) continue;
      const auto emission = start.light->emit({u[0], u[1]}, {u[2], u[3]});
      if (!emission || is_black(emission->flux)) continue;
      if (light.glow.medium != kNoMedium && (frames = frames_in(light.glow, scene, emission->ray, frames)).empty())
        continue;
      const Spectrum carried = carried_at_start(start, emission->flux, *scene.palette);
      if (is_black(carried)) continue;
      const Spectrum flux = carried * start.factor / chosen.density * settings.flux;
      PhotonPath path{{emission->ray, flux, frames}};
      path.start = static_cast<int>(started.size());
      path.random = random, path.strands = start.strands, path.inside = start.inside, path.wavelength = wavelength;
      path.inside.medium = light.media.medium_towards(!(dot(emission->normal, emission->ray.direction) < 0));
      path.hidden = settings.hidden && light.is_delta, path.caustics = light.caustics;
      const LightStart place{emission->ray, emission->normal, emission->primitive};
      started.push_back(
          {path,
           {light, *start.light, place, emission->must_reach, chosen.light, light_seen(*emission), emission->flux},
           start.varied,
           is_light(emission->flux) && is_light(flux) && is_finite(emission->ray)});
    }
  }
}

FrameArray<FrameFactor> weights_of_states(const Palette& palette, const SceneLight::Alike& alike, const Ray& start,
                                          const Rgb& flux, FrameSet& invalid) {
  const Light& first = *alike.first;
  FrameArray<FrameFactor> weights;
  for (const auto& [frames, light] : alike.states) {
    const Rgb in_rgb = light->ratio_along(first, start);
    const Spectrum weight =
        palette.is_rgb() ? palette.carried(in_rgb) : light->carried(flux * in_rgb, palette) / max_component(flux);
    if (is_light(weight))
      weights.add({frames, weight});
    else
      invalid |= frames;
  }
  return weights;
}

}  // namespace dspm
