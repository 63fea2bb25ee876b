#include "dspm/integrators/photon_starts.h"

#include "dspm/colour/rgb.h"
#include "dspm/math/frames.h"

namespace dspm {

PhotonStarts::PhotonStarts(const Scene& scene, bool share_paths) {
  for (const SceneLight& light : scene.lights) {
    std::vector<PhotonStart>& starts = of_light_.emplace_back();
    if (!share_paths) {
      light.states.for_each(scene.frames(), [&](FrameSet frames, const Light& state) {
        starts.push_back({&state, frames, Rgb(1), 0});
      });
      continue;
    }
    for (const SceneLight::Alike& alike : light.alike) {
      const Light& first = *alike.first;
      if (alike.factors.empty()) {
        FrameSet frames;
        for (const auto& state : alike.states) frames |= state.frames;
        starts.push_back({&first, frames, Rgb(1), 0, &alike});
      } else {
        add(first, alike.factors, starts);
      }
    }
  }
}

void PhotonStarts::add(const Light& light, std::span<const FrameFactor> factors, std::vector<PhotonStart>& starts) {
  Strands strands;
  for (const FrameFactor& f : factors)
    if (!is_black(f.factor)) strands.add(f.frames, f.factor);
  if (strands.strands().empty()) return;
  Rgb common;
  const StrandList list = strands_.add(strands, common);
  starts.push_back({&light, strands.frames(), common, list});
}

}  // namespace dspm
