// How pixels and iterations share out even numbers, and what that is worth.
#include "dspm/integrators/camera_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/integrators/dimension.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace camera_numbers_test {

RenderSettings wide() {
  RenderSettings render;
  render.width = 5000, render.height = 3000;
  return render;
}

/// Returns whether these paths sample the square of a slot evenly, in squares.
bool are_even(const std::vector<PathRandom>& paths, int bounce, int dimension) {
  const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(paths.size()))));
  std::vector<int> cells(static_cast<std::size_t>(side * side));
  for (const PathRandom& path : paths) {
    const Vec2 u = path.pair(bounce, dimension);
    const auto x = static_cast<int>(u.x * float(side)), y = static_cast<int>(u.y * float(side));
    ++cells[static_cast<std::size_t>(y * side + x)];
  }
  return std::all_of(cells.begin(), cells.end(), [](int n) { return n == 1; });
}

/// The paths of a square of pixels in some iterations.
std::vector<PathRandom> paths_of(int x0, int y0, int side, int first, int end) {
  std::vector<PathRandom> paths;
  for (int y = y0; y < y0 + side; ++y)
    for (int x = x0; x < x0 + side; ++x)
      for (int i = first; i < end; ++i) paths.push_back(camera_numbers(wide(), 7, x, y, static_cast<std::uint64_t>(i)));
  return paths;
}

TEST(CameraNumbers, OfAPixelAreEvenInEachBlock) {
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(255, 256), std::pair(4999, 2999)})
    for (const auto& [first, end] : {std::pair(0, 4), std::pair(4, 8), std::pair(16, 20), std::pair(16, 32),
                                     std::pair(1024, 2048), std::pair(1 << 20, (1 << 20) + 16)})
      EXPECT_TRUE(are_even(paths_of(x, y, 1, first, end), 1, kLightPoint)) << x << ' ' << y << ' ' << first;
}

TEST(CameraNumbers, OfNeighboursAreEvenTogether) {
  for (const int side : {2, 4, 8, 16}) {
    EXPECT_TRUE(are_even(paths_of(3 * side, 5 * side, side, 0, 4), 1, kScatter)) << side;
    EXPECT_TRUE(are_even(paths_of(256 + side, side, side, 16, 32), 0, kLightDirection)) << side;
  }
}

/// Otherwise the error that two halves show would not be the error.
TEST(CameraNumbers, OfTheFirstAndTheLastHalfAreIndependent) {
  constexpr int kPixels = 4096;
  for (const int half : {4, 8, 16}) {
    double both = 0, first_squares = 0, last_squares = 0;
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      double sum[2] = {};
      for (int i = 0; i < 2 * half; ++i) {
        const Vec2 u = camera_numbers(wide(), 3, pixel % 64, pixel / 64, std::uint64_t(i)).pair(1, kLightPoint);
        sum[i / half] += double(u.x + u.y - 1);
      }
      both += sum[0] * sum[1], first_squares += sum[0] * sum[0], last_squares += sum[1] * sum[1];
    }
    EXPECT_NEAR(both / std::sqrt(first_squares * last_squares), 0, 4 / std::sqrt(kPixels)) << half;
  }
}

TEST(CameraNumbers, InterleaveBits) {
  static_assert(interleave_bits(0xffffu, 0) == 0x55555555u && interleave_bits(2, 3) == 14);
}

TEST(CameraNumbers, MayBeIndependent) {
  RenderSettings render = wide();
  render.independent_numbers = true;
  const PathRandom numbers = camera_numbers(render, 7, 3, 2, 9);
  const PathRandom same(7, Stream::camera, 2 * 5000 + 3, 9);
  EXPECT_EQ(numbers.number(1, 2), same.number(1, 2));
}

constexpr int kSeeds = 8;

/// The mean variance, over pixels and over squares of 8 x 8 pixels.
struct Variance {
  double of_pixels = 0, of_squares = 0;
};

Variance variance(const std::string& text, int iterations) {
  TestScene test(text, Choices());
  constexpr int kSide = 32, kSquare = 8;
  std::vector<double> pixels(kSide * kSide), pixel_squares(pixels), squares(16), square_squares(16);
  for (int seed = 0; seed < kSeeds; ++seed) {
    test.set_seed(static_cast<std::uint64_t>(seed));
    const auto scene = test.scene(test.all_frames());
    const auto made = test.integrator(*scene);
    for (int i = 0; i < iterations; ++i) made->iterate({i, *scene});
    const Image image = made->estimate(0);
    std::vector<double> sums(16);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double value = double(image.at(x, y).g);
        const auto pixel = static_cast<std::size_t>(y * kSide + x);
        pixels[pixel] += value, pixel_squares[pixel] += value * value;
        sums[static_cast<std::size_t>(y / kSquare * 4 + x / kSquare)] += value;
      }
    for (std::size_t i = 0; i < sums.size(); ++i) squares[i] += sums[i], square_squares[i] += sums[i] * sums[i];
  }
  Variance result;
  for (std::size_t i = 0; i < pixels.size(); ++i) result.of_pixels += pixel_squares[i] - pixels[i] * pixels[i] / kSeeds;
  for (std::size_t i = 0; i < squares.size(); ++i)
    result.of_squares += square_squares[i] - squares[i] * squares[i] / kSeeds;
  return result;
}

std::string scene(const std::string& integrator, const std::string& numbers) {
  return box("Option \"numbers\" \"" + numbers + "\" Integrator " + integrator, R"(
AttributeBegin Material "conductor" "float roughness" 0.2 Translate -0.4 -0.6 0.2 Shape "sphere" "float radius" 0.4
AttributeEnd AttributeBegin Translate 0.5 -0.7 -0.2 Shape "sphere" "float radius" 0.3 AttributeEnd)");
}

TEST(EvenNumbers, MakeLessNoiseThanIndependentOnes) {
  struct Case {
    std::string integrator;
    double pixels, squares;  // at most this much of the variance
  };
  for (const Case& c :
       {Case{R"("path" "integer maxdepth" 3)", 0.75, 0.5}, Case{R"("vcm" "integer maxdepth" 3)", 0.9, 0.8},
        Case{R"("dsppm" "integer photons" 2000 "string direct" "sampled")", 0.9, 0.8}}) {
    const Variance even = variance(scene(c.integrator, "even"), 16),
                   independent = variance(scene(c.integrator, "independent"), 16);
    EXPECT_LT(even.of_pixels, c.pixels * independent.of_pixels) << c.integrator;
    EXPECT_LT(even.of_squares, c.squares * independent.of_squares) << c.integrator;
  }
}

}  // namespace camera_numbers_test
}  // namespace dspm::test
