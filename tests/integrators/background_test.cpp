// The background that an infinite light shows to the camera: before everything else, and in no mirror.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace background_test {

constexpr const char* kIntegrators[] = {R"("path")", R"("dsppm" "integer photons" 100)",
                                        R"("sppm" "integer photons" 100)", R"("photonmap" "integer photons" 100)",
                                        R"("vcm" "integer photons" 100)"};

// The left half is a mirror, in which the light behind the camera is seen.
TEST(Background, IsSeenByTheCameraAlone) {
  for (const char* integrator : kIntegrators) {
    TestScene test(fmt::format(R"(
Integrator {}
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" 40
PixelFilter "box"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "infinite" "rgb L" [1 2 3] "rgb background" [.5 .25 .125]
Material "conductor" "rgb reflectance" [1 1 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-9 -9 5  0 -9 5  0 9 5  -9 9 5]
)",
                               integrator));
    const Image image = test.render(FileFrame(0), 2);
    for (int y = 0; y < 8; ++y) {
      EXPECT_NEAR(image.at(7, y).r, .5f, 1e-5f) << integrator;
      EXPECT_NEAR(image.at(7, y).b, .125f, 1e-5f) << integrator;
      EXPECT_NEAR(image.at(0, y).r, 1, 1e-3f) << integrator;
      EXPECT_NEAR(image.at(0, y).b, 3, 1e-3f) << integrator;
    }
  }
}

}  // namespace background_test
}  // namespace dspm::test
