// Walls much thinner than the radius of gathers: little of the light on one side appears on the other. Path tracing,
// which gathers nothing, tells what is right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace thin_walls_test {

constexpr int kTile = 8;

/// A floor that a wall of 0.01 divides, a bright lamp behind it and a faint one on the camera's side; the first radius
/// of gathers is about 0.25.
std::string room(const std::string& integrator, const std::string& lamps) {
  return fmt::format(R"(
Integrator {} "integer maxdepth" 6
LookAt -1.5 3 -3  -.3 0 0  0 1 0
Camera "perspective" "float fov" 40
PixelFilter "box"
Film "rgb" "integer xresolution" 64 "integer yresolution" 64
WorldBegin
{}
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-6 0 -6  6 0 -6  6 0 6  -6 0 6]
Shape "trianglemesh"
  "integer indices" [0 1 2 0 2 3  4 6 5 4 7 6  0 4 5 0 5 1  1 5 6 1 6 2  2 6 7 2 7 3  3 7 4 3 4 0]
  "point3 P" [0 0 -6  .01 0 -6  .01 2 -6  0 2 -6  0 0 6  .01 0 6  .01 2 6  0 2 6]
)",
                     integrator, lamps);
}

/// The largest share of what is right that a tile of 8 x 8 pixels has.
double brightest_tile(const Image& image, const Image& right) {
  double most = 0;
  for (int y = 0; y < image.height; y += kTile)
    for (int x = 0; x < image.width; x += kTile) {
      double has = 0, should = 0;
      for (int i = 0; i < kTile * kTile; ++i) {
        has += static_cast<double>(image.at(x + i % kTile, y + i / kTile).g);
        should += static_cast<double>(right.at(x + i % kTile, y + i / kTile).g);
      }
      most = std::max(most, has / should);
    }
  return most;
}

TEST(ThinWalls, HideLampsOfOnePlace) {
  for (const char* lamps : {
           "LightSource \"point\" \"rgb I\" [10 10 10] \"point3 from\" [2 1.5 0]\n"
           "LightSource \"point\" \"rgb I\" [2 2 2] \"point3 from\" [-2 3 -1]\n",
           "LightSource \"spot\" \"rgb I\" [10 10 10] \"point3 from\" [2 1.5 0] \"point3 to\" [1 0 0]\n"
           "LightSource \"distant\" \"rgb L\" [.2 .2 .2] \"point3 from\" [-2 3 -1] \"point3 to\" [0 0 0]\n",
       }) {
    const Image right = TestScene(room("\"path\"", lamps)).render(FileFrame(0), 128);
    for (const char* integrator : {R"("dsppm" "integer photons" 40000)", R"("sppm" "integer photons" 40000)"}) {
      const Image image = TestScene(room(integrator, lamps)).render(FileFrame(0), 8);
      EXPECT_LT(brightest_tile(image, right), 1.6) << integrator << lamps;
    }
  }
}

}  // namespace thin_walls_test
}  // namespace dspm::test
