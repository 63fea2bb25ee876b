// Parts of pictures, and which of them path finds.
#include "bench/measure/reference.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"

namespace dspm {
namespace reference_test {

/// 16 x 8 pixels, so two blocks: one grey on the left, another on the right.
Image halves(float left, float right) {
  Image image(16, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) image.at(x, y) = Rgb(x < 8 ? left : right);
  return image;
}

const std::vector<bool> kNone = {false, false}, kLeft = {true, false}, kBoth = {true, true};

TEST(Blocks, AreMeans) {
  Image image = halves(1, 3);
  for (int x = 0; x < 16; x += 2) image.at(x, 0) = Rgb(9);  // 4 of 64 pixels on either side
  const Images blocks = in_blocks({image});
  ASSERT_EQ(blocks.size(), 1u);
  ASSERT_EQ(blocks[0].width, 2);
  ASSERT_EQ(blocks[0].height, 1);
  EXPECT_NEAR(blocks[0].at(0, 0).g, 1 + 8 * 4 / 64., 1e-5);
  EXPECT_NEAR(blocks[0].at(1, 0).g, 3 + 6 * 4 / 64., 1e-5);
}

TEST(Blocks, OfTinyImagesAreOne) {
  const Images blocks = in_blocks({Image(3, 5)});
  EXPECT_EQ(blocks[0].width, 1);
  EXPECT_EQ(blocks[0].height, 1);
}

TEST(Agreement, IsWithinATenthOfTheTruth) {
  const Images truth = {halves(1, 1)};
  EXPECT_EQ(agreement(truth, truth).frames[0], kBoth);
  EXPECT_EQ(agreement({halves(1.09f, 0.89f)}, truth).frames[0], kLeft);
  EXPECT_EQ(agreement({halves(0, 1.12f)}, truth).frames[0], kNone);
}

TEST(Agreement, OverlooksNoiseWithinABlock) {
  Image noisy = halves(1, 0.5f);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) noisy.at(x, y) = Rgb((x + y) % 2 == 0 ? 2.f : 0.f);
  EXPECT_EQ(agreement({noisy}, {halves(1, 1)}).frames[0], kLeft);
}

TEST(Agreement, IsByFrame) {
  const Part part = agreement({halves(1, 1), halves(1, 0)}, {halves(1, 1), halves(1, 1)});
  EXPECT_EQ(part.frames, (std::vector{kBoth, kLeft}));
  EXPECT_EQ(part.share(), 0.75);
  EXPECT_EQ(part.rest().frames, (std::vector<std::vector<bool>>{{false, false}, {false, true}}));
  EXPECT_EQ(part.rest().share(), 0.25);
}

TEST(Squares, AreThoseThatARectangleTouches) {
  const Images images = {halves(1, 1), halves(1, 1)};
  EXPECT_EQ(squares_in({0, 0, 8, 8}, images).frames, (std::vector{kLeft, kLeft}));
  EXPECT_EQ(squares_in({7, 7, 9, 8}, images).frames, (std::vector{kBoth, kBoth}));
  EXPECT_EQ(squares_in({}, images).frames, (std::vector{kNone, kNone}));
}

TEST(ErrorOfAPart, IsOfItsPixelsAlone) {
  const Images truth = {halves(1, 3)};  // the floor is 0.02
  const Images image = {halves(1.102f, 0)};
  const Part left{2, 1, {kLeft}};
  EXPECT_NEAR(error_of(image, truth, left), 0.1, 1e-5);
  EXPECT_NEAR(error_of(image, truth, left.rest()), 3 / 3.02, 1e-5);
  EXPECT_NEAR(error_of(in_blocks(image), in_blocks(truth), left), 0.1, 1e-5) << "at another resolution";
  EXPECT_EQ(error_of(image, truth, Part{2, 1, {kNone}}), 0);
}

TEST(ErrorOfAPart, OfAllIsThatOfThePicture) {
  const Images truth = {halves(1, 3)}, image = {halves(2, 1)};
  EXPECT_NEAR(error_of(image, truth, Part{2, 1, {kBoth}}), error_of(image, truth), 1e-12);
}

// A point light: on the left, path finds its light on the floor, on the right it would have to guess the light's place
// through a slab of glass that hides the light from that half.
TEST(Reference, KnowsWhatPathFinds) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "slab.dsc";
  test::put_file(file, R"(
LookAt 0 4 0  0 0 0  0 0 1
Camera "orthographic" "float screenwindow" [-2 2 -1 1]
Film "rgb" "integer xresolution" 32 "integer yresolution" 16 "string filename" "x.exr"
WorldBegin
LightSource "point" "rgb I" [9 9 9] "point3 from" [0 3 0]
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-3 0 -3  3 0 -3  3 0 3  -3 0 3]
Material "dielectric" "float eta" 1.5
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [0 1 -3  5 1 -3  5 1 3  0 1 3]
)");
  const Reference reference = make_reference(Comparison(file, Choices{}), 0.5);
  ASSERT_EQ(reference.seen.columns, 4);
  ASSERT_EQ(reference.seen.rows, 2);
  const std::vector<bool>& seen = reference.seen.frames[0];
  EXPECT_NE(seen[0], seen[3]);
  EXPECT_EQ(std::vector<bool>(seen.begin(), seen.begin() + 4), std::vector<bool>(seen.begin() + 4, seen.end()));
  EXPECT_EQ(reference.seen.share(), 0.5);
  EXPECT_LT(reference.uncertain_seen, 0.05);
}

}  // namespace reference_test
}  // namespace dspm
