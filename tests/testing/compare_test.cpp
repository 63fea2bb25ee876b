#include "dspm/testing/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace dspm {
namespace compare_test {

Image filled(int width, int height, const Rgb& color) {
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = color;
  return image;
}

TEST(Compare, KnownDifferences) {
  const Image reference = filled(4, 2, {1, 2, 3});
  Image image = reference;
  image.at(3, 1).g += 0.5f;
  EXPECT_EQ(mean(reference), Rgb(1, 2, 3));
  EXPECT_DOUBLE_EQ(root_mean_squared_error(image, reference), std::sqrt(0.25 / 24));
  EXPECT_DOUBLE_EQ(relative_mean_squared_error(image, reference), 0.25 / 4.01 / 24);
  EXPECT_EQ(max_difference(image, reference), 0.5);
  EXPECT_EQ(max_difference(reference, reference), 0);
}

TEST(Compare, NanIsNotLost) {
  const Image reference = filled(4, 2, Rgb(1));
  Image image = reference;
  image.at(1, 0).r = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(max_difference(image, reference)));
  EXPECT_TRUE(std::isnan(root_mean_squared_error(image, reference)));
}

TEST(Compare, TilesCoverTheImage) {
  Image image(5, 3), reference = filled(5, 3, Rgb(1));
  image.at(4, 2) = Rgb(8);
  const auto tiles = compare_tiles(image, reference, 2);
  ASSERT_EQ(tiles.size(), 6u);
  for (const TileMeans& tile : tiles) EXPECT_EQ(tile.reference, Rgb(1));
  EXPECT_EQ(tiles[0].image, Rgb(0));
  EXPECT_EQ(tiles[5].x, 4);
  EXPECT_EQ(tiles[5].y, 2);
  EXPECT_EQ(tiles[5].image, Rgb(8)) << "the last tile is a single pixel";
}

TEST(Compare, SizesMustAgree) {
  EXPECT_THROW(max_difference(Image(2, 3), Image(3, 2)), std::invalid_argument);
  EXPECT_THROW(compare_tiles(Image(2, 3), Image(3, 2), 2), std::invalid_argument);
}

}  // namespace compare_test
}  // namespace dspm
