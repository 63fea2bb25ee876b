// What is shared between the times of a shutter must not include what changes while it is open.
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace shutter_sharing_test {

/// Returns the mean brightness of a picture that a glowing square fills, with something before it.
double brightness_behind(const char* contents) {
  const std::string text = R"(
Integrator "path"
PixelFilter "box"
Frames 2
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 0 0 -5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1] "float shutterclose" 1
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
  Shape "bilinearmesh" "point3 P" [-2 -2 1 2 -2 1 -2 2 1 2 2 1]
AttributeEnd
Material "diffuse" "rgb reflectance" [0 0 0]
)" + std::string(contents);
  return static_cast<double>(mean(TestScene(text).render(FileFrame(0), 1024)).g);
}

// The card has no keys itself: 1 - t of it is there at t.
TEST(ShutterSharing, HolesOfATextureThatChanges) {
  EXPECT_NEAR(brightness_behind(R"(
Texture "there" "float" "constant" "float value@1" 1 "float value@2" 0
Shape "bilinearmesh" "point3 P" [-2 -2 0 2 -2 0 -2 2 0 2 2 0] "texture alpha" "there"
)"),
              0.5, 0.004);
}

}  // namespace shutter_sharing_test
}  // namespace dspm::test
