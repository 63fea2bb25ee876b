// Photons are drawn by the seed: where nothing else is random, images of two seeds differ, those of one are the same.
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace seed_test {

/// A matte disk under a lamp. Rays go straight through the middles of pixels, so photons alone are random.
Image disk(const std::string& integrator, int seed) {
  TestScene test("Integrator \"" + integrator + "\" \"integer photons\" 2000 \"integer seed\" " + std::to_string(seed) +
                 R"(
Option "disablepixeljitter" true
Camera "orthographic"
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
WorldBegin
LightSource "point"
Translate 0 0 2 Shape "disk" "float radius" 2
Translate 0 0 -3 Shape "disk" "float radius" 2
)");
  return test.render(FileFrame(0), 1);
}

TEST(Seed, IsThatOfPhotons) {
  for (const char* integrator : {"dsppm", "sppm", "photonmap", "vcm"}) {
    const Image image = disk(integrator, 1);
    EXPECT_EQ(image, disk(integrator, 1)) << integrator;
    EXPECT_FALSE(image == disk(integrator, 2)) << integrator;
  }
}

}  // namespace seed_test
}  // namespace dspm::test
