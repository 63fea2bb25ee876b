// A small picture of the sky, as the background and in a mirror, shows no pixels: what neighbouring pixels of the image
// show differs by no more than its slope.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/base/math/moments.h"
#include "dspm/image/write_floats.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace sky_picture_test {

constexpr int kPixels = 96;

/// The largest difference of neighbouring pixels that show the sky.
float largest_step(const Image& image) {
  float step = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 1; x < image.width; ++x) step = std::max(step, std::abs(image.at(x, y).g - image.at(x - 1, y).g));
  for (int y = 1; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) step = std::max(step, std::abs(image.at(x, y).g - image.at(x, y - 1).g));
  return step;
}

// Four by four or eight by four pixels that alternate between 0 and 1.
TEST(SkyPicture, IsSmoothBehindAndInMirrors) {
  const TemporaryDirectory directory;
  for (const auto& [w, h] : {std::pair{4, 4}, {8, 4}}) {
    Image sky(w, h);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) sky.at(x, y) = Rgb((x + y) % 2 == 0 ? 1.f : 0.f);
    write_pfm(directory / "sky.pfm", sky);
    for (const char* mirror : {"", R"(Material "conductor" "rgb reflectance" [1 1 1]
                                      Translate 0 0 3 Shape "disk" "float radius" 9)"})
      for (const char* portal : {"", R"("point3 portal" [-5 -5 1.5  -5 5 1.5  5 5 1.5  5 -5 1.5])"}) {
        if (*mirror != 0 && *portal != 0) continue;
        TestScene test(fmt::format(R"(
Integrator "path"
Option "disablepixeljitter" true
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" 70
PixelFilter "box"
Film "rgb" "integer xresolution" {0} "integer yresolution" {0}
WorldBegin
AttributeBegin
  Rotate 25 1 2 0
  LightSource "infinite" "string filename" "{1}" {2}
AttributeEnd
{3}
)",
                                   kPixels, (directory / "sky.pfm").string(), portal, mirror));
        const Image image = test.render(FileFrame(0), 1);
        const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end(),
                                                       [](const Rgb& a, const Rgb& b) { return a.g < b.g; });
        EXPECT_GT(most->g - least->g, 0.5f);
        // A pixel of the image is at most 0.015 wide, and one of the sky at least 0.3.
        EXPECT_LT(largest_step(image), 0.06f) << w << mirror << portal;
      }
  }
}

}  // namespace sky_picture_test
}  // namespace dspm::test
