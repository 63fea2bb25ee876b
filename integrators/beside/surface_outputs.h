// Adds what the camera sees first to any integrator: position, depth, normal, albedo, texture coordinates, object and
// material, how it moves in the image, and whether it sees anything; and what denoisers take: the first rough surface
// after smooth ones. Camera rays of their own find it, through the same film and lens points as the integrator's paths,
// so that it is filtered like the image.
#pragma once

#include <memory>

#include "dspm/integrators/beside/make_beside.h"
#include "dspm/integrators/beside/surface_output_list.h"
#include "dspm/integrators/integrator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the integrator that `make` returns (null if it failed), together with the surface outputs in
/// `render.outputs` that it does not declare itself. `memory` is the bound in bytes for both; 0 means none. Throws
/// NotEnoughMemory.
std::unique_ptr<Integrator> with_surface_outputs(const MakeWithin& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory);

}  // namespace dspm
