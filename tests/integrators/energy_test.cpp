// No light is lost or made up: in every frame, what lamps emit is absorbed, escapes, or is cut off.
#include <gtest/gtest.h>

#include "testing/scenes.h"
#include "testing/test_scene.h"
#include "tests/integrators/random_scene.h"

namespace dspm {
namespace {

using test::TestScene;

EnergyBalance balance_of(TestScene& test, Frame frame, int iterations) {
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  for (int i = 0; i < iterations; ++i) integrator->iterate(i);
  return integrator->statistics().energy[static_cast<std::size_t>(frame)];
}

TEST(Energy, IsKeptInEveryFrame) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::string text = test::RandomScene(seed, 6).text(R"(Integrator "dsppm" "integer photons" 5000)");
    SCOPED_TRACE(text);
    TestScene test(text);
    const auto scene = test.scene(test.all_frames());
    const auto integrator = test.integrator(*scene);
    integrator->iterate(0);
    for (const EnergyBalance& e : integrator->statistics().energy) {
      EXPECT_GT(e.emitted, 0);
      EXPECT_NEAR((e.absorbed + e.escaped + e.terminated) / e.emitted, 1, 1e-4);
    }
  }
}

// A lamp of power P in a closed sphere of albedo a: the first hit absorbs (1 - a) P, the second (1 - a) a P, ... With
// at most n hits the sum is (1 - a^(n-1)) P, and a^(n-1) P reaches the last hit, where it is cut off.
TEST(Energy, IsAbsorbedAsTheAlbedoSays) {
  TestScene test(test::furnace(R"("dsppm" "integer photons" 100000 "integer maxdepth" 4)", 0.6f));
  const EnergyBalance e = balance_of(test, 0, 1);
  EXPECT_NEAR(e.absorbed / e.emitted, 1 - 0.6 * 0.6 * 0.6, 0.005);
  EXPECT_NEAR(e.terminated / e.emitted, 0.6 * 0.6 * 0.6, 0.005);
  EXPECT_EQ(e.escaped, 0);
  // pi L A = pi * 1 * 4 pi 2^2, three channels, 100000 paths
  EXPECT_NEAR(e.emitted / (3 * 100000.0 * 16 * 3.14159265 * 3.14159265), 1, 0.002);
}

// Through a clear glass ball nothing is lost: all of a lamp's light leaves the scene.
TEST(Energy, GlassKeepsAll) {
  TestScene test(R"(Integrator "dsppm" "integer photons" 50000 "integer maxdepth" 60
LookAt 0 0 -4 0 0 0 0 1 0
Camera "perspective"
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
WorldBegin
LightSource "point" "point3 from" [0.2 0.1 0.3]
Material "dielectric" "float eta" 1.5
Shape "sphere" "float radius" 1)");
  const EnergyBalance e = balance_of(test, 0, 1);
  EXPECT_NEAR(e.escaped / e.emitted, 1, 1e-3);
  EXPECT_NEAR(e.absorbed / e.emitted, 0, 1e-3);
}

}  // namespace
}  // namespace dspm
