// Rejects what a state that was loaded cannot hold. Checkpoints come from other people: their checksum reveals damage,
// not malice.
#pragma once

#include <stdexcept>
#include <string>

#include "dspm/integrators/integrator.h"

namespace dspm {

/// The most iterations that a run may have.
inline constexpr int kMostIterations = 1'000'000'000;

inline void expect_possible(bool is_possible, const char* what) {
  if (!is_possible) throw std::runtime_error(std::string(what) + " is damaged");
}

inline void expect_iterations(int iterations) {
  expect_possible(iterations >= 0 && iterations <= kMostIterations, "its number of iterations");
}

/// Throws std::runtime_error if a pixel is negative or NaN in any of the frames.
void expect_images(const Integrator& integrator, int frames, bool spectral);

}  // namespace dspm
