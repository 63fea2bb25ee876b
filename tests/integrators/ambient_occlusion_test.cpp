// How much of the sky is seen, in cases where that is known.
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/scenes.h"

namespace dspm::test {
namespace ambient_occlusion_test {

void expect_seen(const std::string& scene, int iterations, float share) {
  const Verdict verdict = agreement(rendered(scene, iterations), Rgb(share));
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

TEST(AmbientOcclusion, APlaneSeesAllOfTheSky) {
  expect_seen(open_furnace(R"("ambientocclusion")", R"("diffuse")"), 2, 1);
}

TEST(AmbientOcclusion, UniformRaysHaveTheSameMean) {
  expect_seen(open_furnace(R"("ambientocclusion" "bool cossample" false)", R"("diffuse")"), 64, 1);
}

TEST(AmbientOcclusion, InsideASphereNothingIsSeen) { expect_seen(furnace(R"("ambientocclusion")", 0), 2, 0); }

// A ray at an angle a from the normal of a sphere of radius 2 goes 4 cos a far. With the density of the rays, cos a / pi,
// the share cos^2 a = 1/16 of them is met within a distance of 1.
TEST(AmbientOcclusion, WhatIsFartherAwayDoesNotMatter) {
  expect_seen(furnace(R"("ambientocclusion" "float maxdistance" 1)", 0), 16, 15 / 16.f);
}

}  // namespace ambient_occlusion_test
}  // namespace dspm::test
