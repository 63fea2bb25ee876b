// Shadow catchers: shapes that the image shows as shadows only, in its alpha, so that it lies over a photograph of what
// they stand for. The same frames are rendered once more without the objects. They share everything if the catchers and
// lights stay, and use the same random numbers, so what no object changes has no noise. [Debevec 1998, as an alpha]
//
// Of the light that a catcher sends to a pixel, E with the objects and E0 without, each over the share of camera paths
// that meet the catcher first, c and c0:
//   k      = min over r, g, b of (E/c) / (E0/c0), at most 1     what is left of the light
//   alpha  = (share of paths that meet a surface) - c k
//   colour = (what the other paths see) + E - c k E0/c0
#pragma once

#include <functional>
#include <memory>

#include "dspm/integrators/integrator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Makes an integrator for a scene and settings; null if it failed.
using MakeForScene = std::function<std::unique_ptr<Integrator>(const Scene&, const RenderSettings&)>;

/// Returns the integrator with its surface outputs, as with_surface_outputs() does; if the scene has catchers, they are
/// at work in it. The integrator must then give caught light. Throws NotEnoughMemory.
std::unique_ptr<Integrator> with_shadow_catchers(const MakeForScene& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory);

}  // namespace dspm
