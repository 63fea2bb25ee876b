// Checks of a material: sample, pdf_w and evaluate of its Bsdf agree, and no light is created. Each check uses a plain
// surface and one with a bent shading normal, directions from straight on to grazing, outside and inside, and every
// subset of the lobes. Random numbers are fixed: a pass stays a pass.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/material.h"
#include "dspm/testing/verdict.h"

namespace dspm::test {

/// Returns the material that a scene gets for these words: `"velvet" "float falloff" 4`. Throws SceneError for a
/// mistake in them.
std::shared_ptr<const Material> material_of(const std::string& words);

/// Tests `samples` of each case against pdf_w by chi-square, for radiance and, on the bent surface, for flux. The chance
/// that a correct material fails any of them is `level`.
Verdict samples_follow_density(const Material& material, double level = 0.01, std::uint64_t seed = 1,
                               int samples = 40'000);
/// Checks that sample's weight is f |cos| / pdf_w, by evaluate and pdf_w.
Verdict weights_agree(const Material& material);
/// Checks that f is finite, not negative, sampled wherever it is not 0, and 0 where the normals disagree about light's
/// side.
Verdict keeps_to_sides(const Material& material);
/// Checks that f for flux is f for radiance with the directions exchanged; on one side of a plain surface both are
/// equal.
Verdict is_reciprocal(const Material& material);
/// Checks that no more light comes back than came in.
Verdict gains_nothing(const Material& material);

/// Runs all of these checks.
Verdict check_scattering(const std::string& words);

/// The fraction of light from wo that is scattered: the mean weight of samples of all lobes, and its standard error.
/// u.z is stratified, so that specular choices hardly vary.
struct Albedo {
  Spectrum mean, error;
};
Albedo albedo(const Bsdf& bsdf, const Vec3& wo, Transport transport, const PathRandom& random, int samples);

}  // namespace dspm::test
