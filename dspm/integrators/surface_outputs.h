// What the camera sees first, for any integrator: position, depth, normal, albedo, texture coordinates, object and
// material, and whether it sees anything; and what denoisers take: the first rough surface behind smooth ones. Camera
// rays of their own find it, through the same film and lens points as the integrator's paths, so that
// it is filtered like the image.
#pragma once

#include <memory>

#include "dspm/integrators/integrator.h"
#include "dspm/integrators/make_beside.h"
#include "dspm/integrators/surface_output_list.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// The integrator that `make` returns (null if it failed), together with those of the surface outputs in
/// `render.outputs` that it does not declare itself. `memory`: bytes for both; 0: no bound. Throws NotEnoughMemory.
std::unique_ptr<Integrator> with_surface_outputs(const MakeWithin& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory);

}  // namespace dspm
