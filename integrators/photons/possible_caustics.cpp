#include "dspm/integrators/photons/possible_caustics.h"

#include <algorithm>

#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/lobe_choice.h"
#include "dspm/integrators/transport/path_step.h"

namespace dspm {
namespace {

struct Lobes {
  bool smooth = false, specular = false;
};

Lobes lobes_of(const Material& material, float least_alpha) {
  constexpr int kSide = 5;  // of the grid of points
  Lobes any;
  for (int i = 0; i < kSide * kSide; ++i) {
    SurfacePoint point{};
    const Vec2 uv{(static_cast<float>(i % kSide) + 0.37f) / kSide, (static_cast<float>(i / kSide) + 0.61f) / kSide};
    point.ng = point.ns = {0, 0, 1}, point.dpdu = {1, 0, 0}, point.dpdv = {0, 1, 0};
    point.uv = uv, point.p = {uv.x, uv.y, uv.x - uv.y};
    BsdfSlot slot;
    const Bsdf& bsdf = material.at(point).bsdf(point, slot);
    const LobeSet all = bsdf.all_lobes();
    any.smooth |= gathering_lobes(bsdf, point, least_alpha) != all;
    any.specular |= bsdf.lobes(kLeastRoughness) != all;
  }
  return any;
}

}  // namespace

PossibleCaustics possible_caustics(const Scene& scene, float least_alpha) {
  const auto is_used = [&](std::size_t material) {
    return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                       [&](const PlacedShape& shape) { return shape.material == static_cast<int>(material); });
  };
  Lobes any;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!is_used(i)) continue;
    for (const auto& state : scene.materials[i].states) {
      const Lobes lobes = lobes_of(*state.object, least_alpha);
      any.smooth |= lobes.smooth, any.specular |= lobes.specular;
    }
  }
  if (!any.smooth) return PossibleCaustics::none;
  const bool switched_off =
      std::any_of(scene.lights.begin(), scene.lights.end(), [](const SceneLight& light) { return !light.caustics; }) ||
      std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const PlacedShape& shape) { return !shape.caustics; });
  const bool hidden = any.specular && std::any_of(scene.lights.begin(), scene.lights.end(),
                                                  [](const SceneLight& light) { return light.is_delta; });
  return switched_off || hidden ? PossibleCaustics::only_by_photons : PossibleCaustics::also_by_paths;
}

}  // namespace dspm
