#include "dspm/integrators/photons/photon_starts.h"

#include <map>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/body.h"

namespace dspm {
namespace {

/// Repeats the starts for each list of bodies that a light lies in, in some frames.
std::vector<PhotonStart> by_bodies(const Scene& scene, const std::vector<PhotonStart>& starts) {
  std::vector<PhotonStart> parts;
  for (const PhotonStart& start : starts) {
    std::map<Inside, FrameSet> places;
    const auto emission = start.light->is_infinite() ? std::nullopt : start.light->emit({0.5f, 0.5f}, {0.5f, 0.5f});
    start.frames.for_each([&](Frame f) {
      places[emission ? inside_at(scene, emission->ray.origin, f) : Inside()] |= FrameSet::single(f);
    });
    for (const auto& [inside, frames] : places) {
      PhotonStart& part = parts.emplace_back(start);
      part.inside = inside, part.frames = frames;
    }
  }
  return parts;
}

/// Returns whether the states' light differs in more than its strength. What paths carry of two colours of a spectral
/// render then has a ratio that depends on the colours.
bool differ_in_colour(const SceneLight::Alike& alike) {
  const auto is_grey = [](const FrameFactor& f) {
    const auto [least, most] = std::minmax({f.factor[0], f.factor[1], f.factor[2]});
    return most - least <= 1e-6f * most;
  };
  const auto has_same = [&](const auto& state) {
    const auto &a = state.object->spectrum(), &b = alike.first->spectrum();
    return a == b || (a != nullptr && b != nullptr && *a == *b);
  };
  return !std::all_of(alike.factors.begin(), alike.factors.end(), is_grey) ||
         !std::all_of(alike.states.begin(), alike.states.end(), has_same);
}

}  // namespace

PhotonStarts::PhotonStarts(const Scene& scene, bool share_paths) {
  for (const LightChoice& choice : scene.light_choices) {
    auto& of_light = of_choice_.emplace_back();
    for (const SceneLight& light : scene.lights) {
      of_light.push_back(starts_of(light, choice.frames, share_paths, *scene.palette));
      if (!scene.bounds_bodies.empty()) of_light.back() = by_bodies(scene, of_light.back());
    }
  }
}

std::vector<PhotonStart> PhotonStarts::starts_of(const SceneLight& light, FrameSet frames, bool share_paths,
                                                 const Palette& palette) {
  std::vector<PhotonStart> starts;
  if (!share_paths) {
    light.states.for_each(frames, [&](FrameSet common, const Light& state) {
      starts.push_back({&state, common, Spectrum(1), 0});
    });
    return starts;
  }
  for (const SceneLight::Alike& alike : light.alike) {
    const Light& first = *alike.first;
    if (alike.factors.empty() || (!palette.is_rgb() && differ_in_colour(alike))) {
      FrameSet all;
      for (const auto& state : alike.states) all |= state.frames & frames;
      if (!all.empty()) starts.push_back({&first, all, Spectrum(1), 0, &alike});
    } else {
      add(first, alike.factors, frames, starts);
    }
  }
  return starts;
}

void PhotonStarts::add(const Light& light, std::span<const FrameFactor> factors, FrameSet frames,
                       std::vector<PhotonStart>& starts) {
  Strands strands;
  for (const FrameFactor& f : factors)
    if (const FrameSet common = f.frames & frames; !common.empty() && !is_black(f.factor))
      strands.add(common, f.factor);
  if (strands.strands().empty()) return;
  Spectrum common;
  const StrandList list = strands_.add(strands, common);
  starts.push_back({&light, strands.frames(), common, list});
}

}  // namespace dspm
