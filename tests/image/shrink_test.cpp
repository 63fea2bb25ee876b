#include "dspm/image/shrink.h"

#include <gtest/gtest.h>

#include "dspm/testing/compare.h"

namespace dspm {
namespace shrink_test {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = Rgb(static_cast<float>(x), static_cast<float>(y), 1);
  }
  return image;
}

TEST(Shrink, BlocksBecomeTheirMeans) {
  const Image small = shrunk(gradient(6, 4), 3, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      EXPECT_EQ(small.at(x, y), Rgb(2 * static_cast<float>(x) + 0.5f, 2 * static_cast<float>(y) + 0.5f, 1));
    }
  }
}

TEST(Shrink, PartsOfPixelsCountByTheirShare) {
  Image image(3, 1);
  image.at(0, 0) = Rgb(3), image.at(1, 0) = Rgb(6), image.at(2, 0) = Rgb(12);
  const Image small = shrunk(image, 2, 1);
  EXPECT_NEAR(small.at(0, 0).r, (3 + 6 * 0.5f) / 1.5f, 1e-6);
  EXPECT_NEAR(small.at(1, 0).r, (12 + 6 * 0.5f) / 1.5f, 1e-6);
}

TEST(Shrink, KeepsTheMean) {
  const Image image = gradient(67, 53);
  for (const int size : {1, 7, 40, 53, 60}) {
    const Rgb before = mean(image), after = mean(shrunk(image, size, size));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c], before[c], 1e-4) << size;
  }
}

TEST(Shrink, TheSameSizeIsTheSameImage) { EXPECT_EQ(shrunk(gradient(9, 5), 9, 5), gradient(9, 5)); }

}  // namespace shrink_test
}  // namespace dspm
