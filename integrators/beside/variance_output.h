// The variance of a pixel's radiance, estimated while an integrator iterates, from its images alone: so it works for
// every integrator, plugins included.
//
// After n iterations the image is the mean E_n of those of single ones. The n-th was x = n E_n - (n-1) E_n-1, so the sum
// of squared distances from the mean grows by (x - E_n-1)(x - E_n) = n (n-1) (E_n - E_n-1)^2 [Welford 1962]. Over n
// (n-1) it is the variance of E_n, if iterations are independent of one another.
//
// Those with even numbers are not: they know of each other so that their mean has less variance. But when iterations
// have doubled, both halves are independent, so (E_n - E_n/2)^2 has the mean that the variance of E_n is. Of one pixel
// it says next to nothing. So the variance above is multiplied by the quotient of the two over pixels around it.
#pragma once

#include <memory>

#include "dspm/integrators/beside/make_beside.h"
#include "dspm/integrators/integrator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

inline constexpr const char* kVarianceOutput = "variance";

/// Returns the integrator that `make` returns (null if it failed), with the output "variance" if `render.outputs` names
/// it and it does not declare one itself: 0 before the second iteration, and that of independent iterations before the
/// eighth. Keeps 40 bytes per pixel and frame. `memory`
/// is the bound in bytes for both; 0 means none. Throws NotEnoughMemory.
std::unique_ptr<Integrator> with_variance_output(const MakeWithin& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory);

}  // namespace dspm
