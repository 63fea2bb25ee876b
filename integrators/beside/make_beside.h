// Makes an integrator that another one wraps, if memory is bounded.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "dspm/integrators/integrator.h"

namespace dspm {

/// Makes an integrator that may hold that many bytes; 0 means that there is no bound.
using MakeWithin = std::function<std::unique_ptr<Integrator>(std::size_t memory)>;

/// Makes an integrator with `memory` less the `taken` bytes of what wraps it. Throws NotEnoughMemory, with both in its
/// figures.
std::unique_ptr<Integrator> make_beside(std::size_t taken, const MakeWithin& make, std::size_t memory);

}  // namespace dspm
