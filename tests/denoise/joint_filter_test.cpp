// What the joint filter makes of images whose answer is known.
#include "dspm/image/denoise/joint_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

constexpr int kSize = 80;  // not a multiple of a tile
constexpr int kBorder = 10;

/// A grey wall that faces the camera, under light of radiance 1 that is known exactly.
NoisyImage wall() {
  const Image empty(kSize, kSize);
  NoisyImage image{empty, empty, empty, empty, empty};
  for (std::size_t i = 0; i < empty.pixels.size(); ++i) {
    image.radiance.pixels[i] = Rgb(1), image.albedo.pixels[i] = Rgb(0.5f);
    image.normal.pixels[i] = Rgb(0, 0, 1), image.depth.pixels[i] = Rgb(4);
  }
  return image;
}

void fill(Image& image, const std::function<Rgb(int x, int y)>& value) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.at(x, y) = value(x, y);
}

/// Adds noise of this standard deviation, and says so.
void add_noise(NoisyImage& image, float deviation) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0, deviation);
  for (Rgb& pixel : image.radiance.pixels) pixel += Rgb(normal(random), normal(random), normal(random));
  for (Rgb& pixel : image.variance.pixels) pixel = Rgb(deviation * deviation);
}

/// The mean squared distance from that, away from the borders.
double error(const Image& image, const std::function<Rgb(int x, int y)>& value) {
  double sum = 0;
  int count = 0;
  for (int y = kBorder; y < kSize - kBorder; ++y)
    for (int x = kBorder; x < kSize - kBorder; ++x)
      for (int c = 0; c < 3; ++c, ++count) sum += std::pow(double(image.at(x, y)[c]) - double(value(x, y)[c]), 2);
  return sum / count;
}

double largest_distance(const Image& a, const Image& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
  return double(largest);
}

Rgb one(int, int) { return Rgb(1); }

TEST(JointFilter, WithoutVarianceNothingChanges) {
  NoisyImage image = wall();
  add_noise(image, 0.1f);
  image.variance = Image(kSize, kSize);
  EXPECT_EQ(joint_filtered(image), image.radiance);
}

TEST(JointFilter, AConstantImageStays) {
  NoisyImage image = wall();
  for (Rgb& pixel : image.variance.pixels) pixel = Rgb(0.01f);
  EXPECT_LT(largest_distance(joint_filtered(image), image.radiance), 1e-6);
}

// Independent noise: the mean of n pixels has 1/n of the variance, and a wall's pixels are means of 57, up to weights
// that the noise of patches lowers a little.
TEST(JointFilter, NoiseShrinksByTheNumberOfPixels) {
  NoisyImage image = wall();
  add_noise(image, 0.1f);
  const double before = error(image.radiance, one), after = error(joint_filtered(image), one);
  EXPECT_NEAR(before, 0.01, 0.0005);
  EXPECT_NEAR(before / after, 57, 6);
}

// A floor: 1 / depth falls linearly. Its pixels are those of one surface, as the wall's are.
TEST(JointFilter, ASlantIsNoEdge) {
  NoisyImage image = wall();
  add_noise(image, 0.1f);
  fill(image.depth, [](int, int y) { return Rgb(1 / (0.5f - 0.005f * static_cast<float>(y))); });
  EXPECT_NEAR(error(image.radiance, one) / error(joint_filtered(image), one), 57, 6);
}

// Noise so strong that colours tell nothing.
TEST(JointFilter, EdgesOfSurfacesStay) {
  const auto expect_edge = [](const char* what, const std::function<void(NoisyImage&)>& part) {
    NoisyImage image = wall();
    fill(image.radiance, [](int x, int) { return Rgb(x < 40 ? 1.f : 3.f); });
    for (Rgb& pixel : image.variance.pixels) pixel = Rgb(100);
    part(image);
    EXPECT_LT(largest_distance(joint_filtered(image), image.radiance), 1e-5) << what;
  };
  expect_edge("normal", [](NoisyImage& image) {
    fill(image.normal, [](int x, int) { return x < 40 ? Rgb(0, 0, 1) : Rgb(0, 1, 0); });
  });
  expect_edge("depth",
              [](NoisyImage& image) { fill(image.depth, [](int x, int) { return Rgb(x < 40 ? 4.f : 6.f); }); });
  expect_edge("albedo",
              [](NoisyImage& image) { fill(image.albedo, [](int x, int) { return Rgb(x < 40 ? 0.3f : 0.9f); }); });
  expect_edge("nothing", [](NoisyImage& image) {
    fill(image.depth, [](int x, int) { return Rgb(x < 40 ? 4.f : 1e10f); });
    fill(image.normal, [](int x, int) { return Rgb(0, 0, x < 40 ? 1.f : 0.f); });
  });
}

TEST(JointFilter, EdgesOfLightStayIfTheyExceedTheNoise) {
  const auto shadow = [](int x, int) { return Rgb(x < 40 ? 1.f : 3.f); };
  NoisyImage image = wall();
  fill(image.radiance, shadow);
  add_noise(image, 0.1f);
  const double before = error(image.radiance, shadow), after = error(joint_filtered(image), shadow);
  EXPECT_GT(before / after, 30);
}

TEST(JointFilter, AFireflyDoesNotSpread) {
  NoisyImage image = wall();
  add_noise(image, 0.01f);
  image.radiance.at(40, 40) = Rgb(1000);
  image.variance.at(40, 40) = Rgb(1e6f);
  const Image result = joint_filtered(image);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      if (x != 40 || y != 40) {
        EXPECT_NEAR(result.at(x, y).r, 1, 0.05) << x << ' ' << y;
      }
}

/// A ball before black, beside one before a wall; its texture is so dark in blue that divisors reach their least. Pixels
/// at its edge show parts of both, as do all that is known of them.
struct BallScene {
  NoisyImage noisy = wall();
  Image truth{kSize, kSize};

  static constexpr float kDeviation = 0.04f;  // of the noise, relative
  static float covered(int x, int y) {
    const float distance = std::hypot(static_cast<float>(x % 40) - 20, static_cast<float>(y % 40) - 20);
    return std::clamp(15 - distance, 0.f, 1.f);
  }
  explicit BallScene(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> uniform(0, 1);
    const float blue = 0.01f + 0.03f * uniform(random);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const float c = covered(x, y), u = (static_cast<float>(x % 40) - 20) / 15, shade = 1.2f - std::abs(u);
        const bool has_wall = x < 40;
        const Rgb albedo(0.8f, 0.2f, blue * (1 + 0.1f * normal(random)));
        const Rgb behind = has_wall ? Rgb(0.3f) : Rgb();
        const std::size_t i = truth.index(x, y);
        truth.pixels[i] = Rgb(0.8f, 0.2f, blue) * (c * shade) + behind * (1 - c);
        noisy.albedo.pixels[i] = albedo * c + Rgb(has_wall ? 0.5f : 1.f) * (1 - c);
        noisy.normal.pixels[i] = Rgb(u, 0, 1) * (c / std::hypot(u, 1.f)) + Rgb(0, 0, has_wall ? 1.f - c : 0.f);
        noisy.depth.pixels[i] = Rgb(c > 0 || has_wall ? 4 * c + 8 * (1 - c) : 1e10f);
        for (int k = 0; k < 3; ++k) {
          const float deviation = kDeviation * truth.pixels[i][k];
          noisy.radiance.pixels[i][k] = truth.pixels[i][k] + deviation * normal(random);
          noisy.variance.pixels[i][k] = deviation * deviation;
        }
      }
  }
};

// No pixel is brighter than its own noise explains. Pixels at edges have hardly any like them: they gain nothing, and lose
// little.
TEST(JointFilter, NothingIsInventedAtEdges) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const BallScene scene(seed);
    const Image result = joint_filtered(scene.noisy);
    double before = 0, after = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        for (int c = 0; c < 3; ++c) {
          const float truth = scene.truth.at(x, y)[c], given = scene.noisy.radiance.at(x, y)[c],
                      deviation = BallScene::kDeviation * truth;
          EXPECT_NEAR(result.at(x, y)[c], given, 6 * deviation + 1e-6f) << seed << ": " << x << ' ' << y << ' ' << c;
          const float cover = BallScene::covered(x, y);
          if (cover == 0 || cover == 1 || !(truth > 0)) continue;
          before += std::pow(double(given / truth) - 1, 2),
              after += std::pow(double(result.at(x, y)[c] / truth) - 1, 2);
        }
    EXPECT_LT(after, 1.25 * before) << seed;
  }
}

// One path in many, which has brought a thousand times what others bring; what is as bright and certain of it stays.
TEST(JointFilter, ASpeckGoesAndALampStays) {
  NoisyImage image = wall();
  add_noise(image, 0.05f);
  image.radiance.at(30, 30) = Rgb(60), image.variance.at(30, 30) = Rgb(60 * 60);
  image.radiance.at(50, 50) = Rgb(60), image.variance.at(50, 50) = Rgb(1);
  const Image result = joint_filtered(image);
  EXPECT_NEAR(result.at(30, 30).r, 1, 0.1);
  EXPECT_NEAR(result.at(50, 50).r, 60, 3);
}

// Many pixels of few bright paths, whose mean is the light.
TEST(JointFilter, RarePathsKeepTheirLight) {
  NoisyImage image = wall();
  std::mt19937 random(1);
  std::poisson_distribution<int> hits(1.5);
  for (std::size_t i = 0; i < image.radiance.pixels.size(); ++i) {
    const auto n = static_cast<float>(hits(random));
    image.radiance.pixels[i] = Rgb(n / 1.5f), image.variance.pixels[i] = Rgb(n / (1.5f * 1.5f));
  }
  const auto mean = [](const Image& of) {
    double sum = 0;
    for (const Rgb& pixel : of.pixels) sum += double(pixel.g);
    return sum / double(of.pixels.size());
  };
  EXPECT_NEAR(mean(joint_filtered(image)) / mean(image.radiance), 1, 0.02);
}

TEST(JointFilter, TheSameBitsWithAnyNumberOfThreads) {
  NoisyImage image = wall();
  add_noise(image, 0.3f);
  const Image result = joint_filtered(image);
  const ThreadLimit one_thread(1);
  EXPECT_EQ(joint_filtered(image), result);
}

TEST(JointFilter, IsFiniteWhateverItIsGiven) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
  NoisyImage image = wall();
  add_noise(image, 0.1f);
  image.variance.at(20, 20) = Rgb(kInfinite), image.variance.at(21, 20) = Rgb(kNan);
  image.albedo.at(30, 20) = Rgb(kNan), image.albedo.at(31, 20) = Rgb(-1);
  image.normal.at(40, 20) = Rgb(kInfinite), image.depth.at(50, 20) = Rgb(0), image.depth.at(52, 20) = Rgb(kNan);
  image.radiance.at(60, 20) = Rgb(1e38f), image.radiance.at(62, 20) = Rgb(-1e30f);
  for (const Rgb& pixel : joint_filtered(image).pixels) EXPECT_TRUE(is_finite(pixel));
  for (const int size : {1, 2}) {
    const Image small(size, 1);
    EXPECT_EQ(joint_filtered({small, small, small, small, small}), small);
  }
}

}  // namespace
}  // namespace dspm
