// What denoising leaves of renders: a texture that is seen through water.
#include "dspm/output/denoised.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace denoised_test {

constexpr int kSize = 64;

/// The floor of a basin, tiles in two greys, seen from above through still water, under a sky and a lamp that
/// shadow rays do not find through the water.
constexpr const char* kBasin = R"(
Integrator "path"
LookAt 0 4 0  0 0 0  0 0 1
Camera "perspective" "float fov" 30
Film "rgb" "integer xresolution" 64 "integer yresolution" 64
WorldBegin
LightSource "infinite" "rgb L" [.2 .2 .2]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [3 3 3]
  Translate 4 6 0
  Rotate 90 1 0 0
  Shape "disk" "float radius" 3
AttributeEnd
AttributeBegin
  Texture "tiles" "spectrum" "checkerboard" "float uscale" 24 "float vscale" 24 "rgb tex1" [.6 .6 .6] "rgb tex2" [.4 .4 .4]
  Material "diffuse" "texture reflectance" "tiles"
  Shape "trianglemesh" "point3 P" [-4 0 -4  4 0 -4  4 0 4  -4 0 4] "point2 uv" [0 0 1 0 1 1 0 1] "integer indices" [0 2 1 0 3 2]
AttributeEnd
Material "dielectric" "float eta" 1.33
Shape "trianglemesh" "bool open" true "point3 P" [-4 1 -4  4 1 -4  4 1 4  -4 1 4] "integer indices" [0 2 1 0 3 2]
)";

/// The mean of pixels on light tiles over that of those on dark ones, apart from pixels that show both.
double contrast(const Image& image, const Image& albedo) {
  double sums[2] = {}, counts[2] = {};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float a = albedo.pixels[i].g;
    if (a > 0.41f && a < 0.59f) continue;
    sums[a > 0.5f] += luminance(image.pixels[i]), ++counts[a > 0.5f];
  }
  return sums[1] / counts[1] * counts[0] / sums[0];
}

/// The mean square of steps between neighbours on one tile.
double roughness(const Image& image, const Image& albedo) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 1; x < kSize; ++x) {
      if (std::abs(albedo.at(x, y).g - albedo.at(x - 1, y).g) > 0.01f) continue;
      const double step = luminance(image.at(x, y)) - luminance(image.at(x - 1, y));
      sum += step * step, ++count;
    }
  return sum / count;
}

TEST(Denoised, TilesUnderWaterKeepTheirContrast) {
  Choices choices;
  choices.denoiser = Denoiser::own;
  test::TestScene test(kBasin, choices);
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  for (int i = 0; i < 16; ++i) integrator->iterate({i, *scene});
  const Image plain = integrator->estimate(0), clean = denoised(Denoiser::own, plain, *integrator, 0, {}),
              albedo = integrator->estimate(0, "denoisingalbedo");
  EXPECT_NEAR(contrast(clean, albedo), contrast(plain, albedo), 0.05);
  EXPECT_GT(contrast(clean, albedo),
            1.3);  // 0.6 / 0.4, less what the water reflects and the tiles throw onto each other
  EXPECT_LT(roughness(clean, albedo), roughness(plain, albedo) / 10);
}

}  // namespace denoised_test
}  // namespace dspm
