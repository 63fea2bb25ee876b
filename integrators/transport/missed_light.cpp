#include "dspm/integrators/transport/missed_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

/// Tests the material at an arbitrary point: whether it is such glass everywhere is not known.
bool refracts_sharply(const Material& material) {
  SurfacePoint point{};
  point.ng = point.ns = {0, 0, 1}, point.dpdu = {1, 0, 0}, point.dpdv = {0, 1, 0}, point.uv = {0.5f, 0.5f};
  BsdfSlot slot;
  const Bsdf& bsdf = material.at(point).bsdf(point, slot);
  constexpr int kSteps = 16;  // of the number that chooses the lobe
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 u{0.5f, 0.5f, (static_cast<float>(i) + 0.5f) / kSteps};
    const auto sample = bsdf.sample({0, 0, 1}, u, Transport::radiance, bsdf.all_lobes());
    if (sample && sample->specular && sample->wi.z < 0) return true;
  }
  return false;
}

std::optional<std::size_t> sharp_glass(const Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const bool is_used = std::any_of(scene.shapes.begin(), scene.shapes.end(),
                                     [&](const PlacedShape& shape) { return shape.material == static_cast<int>(i); });
    const auto& states = scene.materials[i].states;
    if (is_used && std::any_of(states.begin(), states.end(), [](const auto& s) { return refracts_sharply(*s.object); }))
      return i;
  }
  return std::nullopt;
}

}  // namespace

std::string missed_light(const Scene& scene) {
  const auto light =
      std::find_if(scene.lights.begin(), scene.lights.end(), [](const SceneLight& l) { return l.is_delta; });
  if (light == scene.lights.end()) return {};
  const std::optional<std::size_t> glass = sharp_glass(scene);
  if (!glass) return {};
  const auto index = static_cast<std::size_t>(light - scene.lights.begin());
  return fmt::format(
      "no path finds light \"{}\", which has no extent, through \"{}\", which is smooth: what only it "
      "lights through that stays black",
      scene.light_names[index], scene.material_names[*glass]);
}

}  // namespace dspm
