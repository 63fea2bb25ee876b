// Small scenes to try integrators on.
#pragma once

#include <string>

namespace dspm::test {

/// A closed body seen from inside. It glows with radiance 1 and reflects a fraction `albedo` diffusely: the radiance L
/// is the same everywhere, L = 1 + albedo L, so L = 1 / (1 - albedo). `integrator` and `shape` go into the directives:
/// "\"path\" \"integer maxdepth\" 40". The camera is at the origin.
std::string furnace(const std::string& integrator, float albedo,
                    const std::string& shape = "\"sphere\" \"float radius\" 2");

/// A flat surface of the material under a sky of radiance 1, seen from straight on to grazing: its radiance is the
/// material's albedo for the direction from which it is seen.
std::string open_furnace(const std::string& integrator, const std::string& material);

/// A Cornell-like box with a lamp under the ceiling; `contents` stands in it. -1 <= x, y, z <= 1, open towards -z.
std::string box(const std::string& options, const std::string& contents, int size = 32);

}  // namespace dspm::test
