// What the materials and lights of a scene tell about caustics before any path is traced.
#pragma once

#include <cstdint>

#include "dspm/world/scene/scene.h"

namespace dspm {

enum class PossibleCaustics : std::uint8_t {
  none,             // all lobes are rough
  also_by_paths,    // camera paths find all of them, however late
  only_by_photons,  // a light without extent shines on specular lobes, or the scene switches some caustics off
};

/// Lobes that are rougher than `least_alpha` throw no caustics. Materials are asked at a few points: they may vary.
PossibleCaustics possible_caustics(const Scene& scene, float least_alpha);

}  // namespace dspm
