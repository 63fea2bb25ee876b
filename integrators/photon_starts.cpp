#include "integrators/photon_starts.h"

namespace dspm {

PhotonStarts::PhotonStarts(const Scene& scene, bool mixture) {
  for (const SceneLight& light : scene.lights) {
    std::vector<PhotonStart>& starts = of_light_.emplace_back();
    for (const SceneLight::Alike& alike : light.alike) {
      const std::size_t together = mixture ? alike.factors.size() : 1;
      for (std::size_t i = 0; i < alike.factors.size(); i += together)
        add(*alike.light, std::span(alike.factors).subspan(i, together), starts);
    }
  }
}

void PhotonStarts::add(const Light& light, std::span<const FrameFactor> factors, std::vector<PhotonStart>& starts) {
  Strands strands;
  for (const FrameFactor& f : factors)
    if (!is_black(f.factor)) strands.add(f.frames, f.factor);
  if (strands.strands().empty()) return;
  const Rgb common = strands.take_common();
  const StrandList list = strands.strands().size() == 1 ? 0 : strands_.add(strands.strands());
  starts.push_back({&light, strands.frames(), common, list});
}

}  // namespace dspm
